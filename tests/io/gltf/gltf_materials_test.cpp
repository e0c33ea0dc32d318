// Materials of glTF files as defaults of a scene's: what is taken, what a scene's own keys win
// over, what is left and said.
#include <gtest/gtest.h>

#include "film/films.hpp"
#include "io/gltf/gltf_files.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

std::string base64(const std::string& bytes) {
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// A square of one material, and a scene of it.
class GltfMaterials : public testing::Test {
  protected:
    GltfMaterials() {
        unsigned seed = 0;
        for (const char* const name : {"base.exr", "bumps.exr", "own.exr"})
            write_exr(folder / name, testing_films::smooth_film(++seed, {0, 0, 16, 9}), {});
        material = {{"name", "brass"},
                    {"doubleSided", true},
                    {"pbrMetallicRoughness",
                     {{"baseColorTexture", {{"index", 0}}},
                      {"metallicFactor", 0},
                      {"roughnessFactor", 0.5}}},
                    {"normalTexture", {{"index", 1}}}};
    }

    void write_mesh() {
        GltfBuilder builder;
        const int positions = builder.floats({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3", 3);
        const int uvs = builder.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
        const int indices = builder.shorts({0, 1, 2, 0, 2, 3});
        const json part = {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                           {"indices", indices},
                           {"material", 0}};
        builder.set_primitive(part);
        builder.json["materials"] = json::array({material});
        builder.json["images"] = images;
        builder.json["samplers"] = samplers;
        builder.json["textures"] = json::array({{{"source", 0}, {"sampler", 0}}, {{"source", 1}}});
        testing_films::write_bytes(folder / "square.gltf", builder.text("square.bin"));
        testing_films::write_bytes(folder / "square.bin", builder.bytes);
    }

    Scene scene_of(const std::string& keys = "", const std::string& mesh = "") {
        write_mesh();
        testing_films::write_bytes(folder / "scene.json",
                                   R"({"quadrel": 1, "size": [24, 24], )" + keys +
                                       R"("objects": [{"mesh": {"file": "square.gltf")" + mesh +
                                       "}}]}");
        return load_scene(folder / "scene.json");
    }
    /// The only one about materials.
    std::string note_of(const Scene& scene) const {
        std::string note;
        for (const std::string& line : scene.notes)
            if (line.find("taken: ") != std::string::npos) note += note.empty() ? line : " twice";
        return note;
    }
    testing_films::TemporaryFolder folder;
    json material;
    json images = json::array({{{"uri", "base.exr"}}, {{"uri", "bumps.exr"}}});
    json samplers = json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
};

TEST_F(GltfMaterials, StandInForWhatTheSceneLeavesOut) {
    const Scene scene = scene_of();
    const Material& taken = scene.materials.at(0);
    const TextureReference& color = taken.textures.at("color");
    EXPECT_EQ(color.file.filename(), "base.exr");
    EXPECT_EQ(color.sampler.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(color.sampler.wrap_v, Wrap::mirrored_repeat);
    EXPECT_EQ(taken.textures.at("normal").file.filename(), "bumps.exr");
    EXPECT_EQ(taken.surface.id, "normal-map");
    EXPECT_EQ(taken.frame.id, "frame-mikkt");
    EXPECT_EQ(taken.shade.id, "shade-metallic-roughness");
    EXPECT_FLOAT_EQ(taken.diffuse.x, 1);
    EXPECT_NE(note_of(scene).find("square.gltf: brass: taken: map of the base colour, normal, "
                                  "roughness, metalness; left: nothing"),
              std::string::npos)
        << note_of(scene);
}

/// The picture is that of a scene which says the same itself.
TEST_F(GltfMaterials, DrawWhatTheSceneWouldSay) {
    const Film taken = render(scene_of(), {});
    const Film said = render(scene_of(R"("material": {
            "color": {"file": "base.exr", "colour_space": "srgb", "mag": "nearest",
                      "wrap": ["clamp-to-edge", "mirrored-repeat"]},
            "normal": {"file": "bumps.exr"}, "ambient": [0.1, 0.1, 0.1, 1],
            "diffuse": [1, 1, 1, 1],
            "shade": {"id": "shade-metallic-roughness", "roughness": 0.5, "metalness": 0},
            "relief": {"frame": "frame-mikkt",
                       "surface": {"id": "normal-map", "green": "down"}}}, )",
                                      R"(, "materials": false)"),
                             {});
    EXPECT_EQ(film_hash(taken), film_hash(said));
    const Film none = render(scene_of("", R"(, "materials": false)"), {});
    EXPECT_NE(film_hash(taken), film_hash(none));
}

/// Normals that lean have an effect, without a word about relief.
TEST_F(GltfMaterials, NormalsLean) {
    RenderOptions options;
    options.channels = {"N"};
    const Film film = render(scene_of(), options);
    double least = 1;
    for (std::size_t i = 0; i < film.window.area(); ++i)
        if (const float z = film.find("N.Z")->as_float(i); z != 0)
            least = std::min(least, std::abs(double(z)));
    EXPECT_LT(least, 0.999);
}

/// What is not there is no default, but a mistake.
TEST_F(GltfMaterials, AFileThatIsMissingIsSaid) {
    images[0]["uri"] = "nowhere.png";
    try {
        scene_of();
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("nowhere.png"), std::string::npos) << error.what();
    }
}

TEST_F(GltfMaterials, TheScenesOwnKeysWin) {
    const Scene scene = scene_of(R"("material": {"color": {"file": "own.exr"},
        "height": {"file": "bumps.exr"}, "shade": "shade-lambert", "cull": "front"}, )");
    const Material& both = scene.materials.at(0);
    EXPECT_EQ(both.textures.at("color").file.filename(), "own.exr");
    EXPECT_FALSE(both.textures.contains("normal"));  // heights say what the normals are
    EXPECT_EQ(both.shade.id, "shade-lambert");
    EXPECT_FLOAT_EQ(both.diffuse.x, 1);
    EXPECT_NE(note_of(scene).find("brass: taken: nothing; the scene's own instead: map of the base "
                                  "colour, normal, roughness, metalness; left: nothing"),
              std::string::npos)
        << note_of(scene);
}

/// A material of the scene may win where another one does not.
TEST_F(GltfMaterials, WhatIsTakenBySomeIsSaidOfThem) {
    write_mesh();
    testing_films::write_bytes(folder / "two.json", R"({"quadrel": 1, "size": [24, 24],
        "materials": {"plain": {}, "painted": {"color": {"file": "own.exr"}}},
        "objects": [{"mesh": {"file": "square.gltf"}, "material": "plain"},
                    {"mesh": {"file": "square.gltf"}, "material": "painted"},
                    {"mesh": {"file": "square.gltf"}, "material": "painted"}]})");
    const std::string note = note_of(load_scene(folder / "two.json"));
    EXPECT_NE(note.find("taken: map of the base colour, normal, roughness, metalness; the scene's "
                        "own instead: map of the base colour; left: nothing"),
              std::string::npos)
        << note;
}

TEST_F(GltfMaterials, FactorsAreTaken) {
    material = {{"pbrMetallicRoughness", {{"baseColorFactor", {1.0, 0.5, 0.25, 1.0}}}},
                {"emissiveFactor", {0.5, 0.0, 0.0}},
                {"alphaMode", "MASK"},
                {"alphaCutoff", 0.25}};
    const Material metal = scene_of().materials.at(0);
    EXPECT_EQ(metal.diffuse, glm::vec4(1, 0.5f, 0.25f, 1));
    EXPECT_EQ(metal.shade.parameters.at("metalness"), ParameterValue(1.0));
    EXPECT_EQ(metal.shade.parameters.at("roughness"), ParameterValue(1.0));
    EXPECT_EQ(metal.emission, glm::vec4(0.5f, 0, 0, 1));
    EXPECT_EQ(metal.discard_below, 0.25f);
    EXPECT_EQ(metal.cull, scene_of(R"("material": {"cull": "back"}, )").materials.at(0).cull);
}

/// A texture's alpha times the factor's is what the cut-off is compared with.
TEST_F(GltfMaterials, TheCutOffTakesTheFactorsAlpha) {
    material["alphaMode"] = "MASK";
    const auto cut_off = [&](double alpha) {
        material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 1.0, 1.0, alpha};
        return scene_of().materials.at(0).discard_below;
    };
    EXPECT_FLOAT_EQ(cut_off(1), 0.5f);
    EXPECT_FLOAT_EQ(cut_off(0.625), 0.8f);
    EXPECT_GT(cut_off(0.25), 1);
    EXPECT_GT(cut_off(0), 1);
}

TEST_F(GltfMaterials, WhatIsNoMaterialIsRefused) {
    const json plain = material;
    const auto refused_at = [&](const char* pointer, const json& value) {
        material = plain;
        material[json::json_pointer(pointer)] = value;
        try {
            scene_of();
        } catch (const InputError& error) {
            EXPECT_NE(error.file.find("square.gltf"), std::string::npos) << error.what();
            return error.key;
        }
        return std::string("nothing");
    };
    const std::string metal = "materials[0].pbrMetallicRoughness.";
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/metallicFactor", "x"), metal + "metallicFactor");
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/roughnessFactor", 7), metal + "roughnessFactor");
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/baseColorFactor", {1, 2}),
              metal + "baseColorFactor");
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/baseColorFactor", {1, 2, 1, 1}),
              metal + "baseColorFactor[1]");
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/baseColorTexture/index", 9),
              metal + "baseColorTexture.index");
    EXPECT_EQ(refused_at("/alphaMode", "mask"), "materials[0].alphaMode");
    EXPECT_EQ(refused_at("/doubleSided", 1), "materials[0].doubleSided");
    EXPECT_EQ(refused_at("/alphaMode", "OPAQUE"), "nothing");
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/metallicFactor", 0.5), "nothing");
}

/// Numbers that glTF gives no meaning, of wrap modes where filters have one among them.
TEST_F(GltfMaterials, WhatIsNoSamplerIsRefused) {
    const auto refused = [&](const char* key, const json& value) -> std::string {
        samplers = json::array({{{key, value}}});
        try {
            scene_of();
        } catch (const InputError& error) {
            EXPECT_NE(error.file.find("square.gltf"), std::string::npos) << error.what();
            EXPECT_EQ(error.found, value.dump());
            return error.key;
        }
        return "nothing";
    };
    for (const auto& [key, known, wrong] : {std::tuple{"wrapS", 10497, 9729},
                                            {"wrapT", 33648, 33069},
                                            {"magFilter", 9729, 9987},
                                            {"minFilter", 9987, 10497}}) {
        EXPECT_EQ(refused(key, wrong), std::string("samplers[0].") + key);
        EXPECT_EQ(refused(key, "9728"), std::string("samplers[0].") + key);
        EXPECT_EQ(refused(key, known), "nothing") << key;
    }
    samplers = json::array();
    EXPECT_THROW(scene_of(), InputError) << "the first texture has one";
}

TEST_F(GltfMaterials, WhatIsLeftIsSaid) {
    material["occlusionTexture"] = {{"index", 0}};
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
    material["normalTexture"]["texCoord"] = 1;
    material["emissiveTexture"] = {
        {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2.0, 2.0}}}}}}};
    material["emissiveFactor"] = {1, 1, 1};
    const Scene scene = scene_of();
    for (const char* const part : {"occlusion (another image", "normal (another set",
                                   "emission (another texture transform)"})
        EXPECT_NE(note_of(scene).find(part), std::string::npos) << note_of(scene);
    EXPECT_FALSE(scene.materials[0].textures.contains("normal"));
    EXPECT_FALSE(scene.materials[0].textures.contains("emissive"));
}

/// The mesh has it in its texture coordinates.
TEST_F(GltfMaterials, ATransformOfAllTexturesIsTaken) {
    const json transform = {{"KHR_texture_transform", {{"scale", {2.0, 3.0}}}}};
    material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = transform;
    material["normalTexture"]["extensions"] = transform;
    const Scene scene = scene_of();
    EXPECT_TRUE(scene.materials[0].textures.contains("color"));
    EXPECT_TRUE(scene.materials[0].textures.contains("normal"));
    EXPECT_EQ(scene.meshes.at(0).uvs.at(0), glm::vec2(0, 3));
}

/// Occlusion, roughness and metalness as one map, or as one or two of the three.
TEST_F(GltfMaterials, RoughnessAndOcclusionAreChannelsOfOneMap) {
    json& metal = material["pbrMetallicRoughness"];
    const auto gloss = [&] { return scene_of().materials.at(0).textures.at("gloss"); };
    metal["metallicRoughnessTexture"] = {{"index", 1}};
    EXPECT_EQ(gloss().swizzle, "1gb");
    EXPECT_EQ(gloss().file.filename(), "bumps.exr");
    EXPECT_FALSE(gloss().srgb);
    material["occlusionTexture"] = {{"index", 1}, {"strength", 0.25}};
    EXPECT_EQ(gloss().swizzle, "rgb");
    EXPECT_EQ(scene_of().materials[0].shade.parameters.at("occlusion_strength"),
              ParameterValue(0.25));
    metal.erase("metallicRoughnessTexture");
    EXPECT_EQ(gloss().swizzle, "r11");
    EXPECT_NE(note_of(scene_of()).find("occlusion"), std::string::npos);
}

/// A square of each, side by side; a third one without a material.
class SeveralGltfMaterials : public GltfMaterials {
  protected:
    SeveralGltfMaterials() {
        GltfBuilder builder;
        const int indices = builder.shorts({0, 1, 2, 0, 2, 3});
        builder.set_primitive(json::object());
        json& primitives = builder.json["meshes"][0]["primitives"] = json::array();
        for (int i = 0; i < 3; ++i) {
            const float x = static_cast<float>(i) * 2 - 3;
            const int positions =
                builder.floats({x, -1, 0, x + 2, -1, 0, x + 2, 1, 0, x, 1, 0}, "VEC3", 3);
            json part = {{"attributes", {{"POSITION", positions}}}, {"indices", indices}};
            if (i < 2) {
                part["attributes"]["TEXCOORD_0"] =
                    builder.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
                part["material"] = i;
            }
            primitives.push_back(part);
        }
        json other = {{"name", "glass"},
                      {"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 1.0, 1.0}}}}};
        builder.json["materials"] = {material, other};
        builder.json["images"] = images;
        builder.json["textures"] = json::array({{{"source", 0}}, {{"source", 1}}});
        testing_films::write_bytes(folder / "row.glb", builder.binary());
    }

    Scene row_scene(const std::string& objects, const std::string& keys = "") {
        testing_films::write_bytes(folder / "row.json",
                                   R"({"quadrel": 1, "size": [36, 12], "camera":
            {"type": "orthographic", "height": 2}, "lights": [{"position": [0, 0, 9]}], )" +
                                       keys + R"("objects": [)" + objects + "]}");
        return load_scene(folder / "row.json");
    }
    static std::string part(int number, const std::string& named) {
        return R"({"mesh": {"file": "row.glb", "materials": false, "material": )" +
               std::to_string(number) + R"(}, "material": ")" + named + "\"}";
    }
    const std::string whole = R"({"mesh": {"file": "row.glb"}})";
};

TEST_F(SeveralGltfMaterials, EachPartHasItsOwn) {
    const Scene scene = row_scene(whole);
    ASSERT_EQ(scene.objects.size(), 3u);
    const auto worn = [&](std::size_t i) { return scene.materials[scene.objects[i].material]; };
    EXPECT_EQ(worn(0).name, "default");  // of what has none
    EXPECT_EQ(worn(1).name, "default: brass");
    EXPECT_EQ(worn(1).textures.at("color").file.filename(), "base.exr");
    EXPECT_EQ(worn(2).name, "default: glass");
    EXPECT_FLOAT_EQ(worn(2).diffuse.x, 0.25f);
    EXPECT_EQ(scene.objects[2].name, "object 0: glass");
    for (const Object& object : scene.objects)
        EXPECT_EQ(scene.meshes[object.mesh].triangles.size(), 2u);
    const std::string note = note_of(scene);
    for (const char* const text :
         {"row.glb: 2 materials: taken: ", "normal of brass", "roughness", "base colour of glass"})
        EXPECT_NE(note.find(text), std::string::npos) << note;
}

/// The picture is that of three objects which say the same themselves.
TEST_F(SeveralGltfMaterials, DrawWhatTheSceneWouldSay) {
    const std::string shade = R"("shade": {"id": "shade-metallic-roughness", "roughness": )";
    const std::string named = R"("materials": {
        "plain": {},
        "brass": {"color": {"file": "base.exr", "colour_space": "srgb"},
                  "normal": {"file": "bumps.exr"}, "ambient": [0.1, 0.1, 0.1, 1],
                  "diffuse": [1, 1, 1, 1], )" +
                              shade + R"(0.5, "metalness": 0},
                  "relief": {"frame": "frame-mikkt",
                       "surface": {"id": "normal-map", "green": "down"}}},
        "glass": {"ambient": [0.025, 0.05, 0.1, 1], "diffuse": [0.25, 0.5, 1, 1], "cull": "back", )" +
                              shade + R"(1, "metalness": 1}}}, )";
    const Film taken = render(row_scene(whole), {});
    const std::string three = part(-1, "plain") + ", " + part(0, "brass") + ", " + part(1, "glass");
    EXPECT_EQ(film_hash(taken), film_hash(render(row_scene(three, named), {})));
    const std::string swapped =
        part(-1, "plain") + ", " + part(1, "brass") + ", " + part(0, "glass");
    EXPECT_NE(film_hash(taken), film_hash(render(row_scene(swapped, named), {})));
    const Film none = render(
        row_scene(R"({"mesh": {"file": "row.glb", "materials": false}})", R"("material": {}, )"),
        {});
    EXPECT_NE(film_hash(taken), film_hash(none));
}

TEST_F(SeveralGltfMaterials, AKeyChoosesOne) {
    const auto chosen = [&](const std::string& which) {
        return row_scene(R"({"mesh": {"file": "row.glb", "material": )" + which + "}}");
    };
    for (const char* const glass : {"1", "\"glass\""}) {
        const Scene scene = chosen(glass);
        ASSERT_EQ(scene.objects.size(), 1u);
        EXPECT_EQ(scene.meshes.at(scene.objects[0].mesh).triangles.size(), 2u);
        EXPECT_FLOAT_EQ(scene.materials.at(0).diffuse.z, 1);
        EXPECT_NE(note_of(scene).find("row.glb: glass: taken"), std::string::npos);
    }
    EXPECT_TRUE(chosen("-1").materials.at(0).shade.id.empty());
    const auto refused = [&](const std::string& which) -> std::string {
        try {
            chosen(which);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refused("\"glas\"").find("glass"), std::string::npos) << refused("\"glas\"");
    EXPECT_NE(refused("2").find("-1 to 1"), std::string::npos) << refused("2");
    EXPECT_NE(refused("0.5").find("row.json"), std::string::npos) << refused("0.5");
    testing_films::write_bytes(folder / "square.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THROW(row_scene(R"({"mesh": {"file": "square.obj", "material": 0}})"), InputError);
}

/// Others stay where and what they are; several files may share a material of the scene.
TEST_F(SeveralGltfMaterials, OtherObjectsKeepTheirPlacesAndMaterials) {
    write_mesh();
    const Scene scene = row_scene(
        whole + R"(, {"name": "ball", "mesh": "sphere"}, {"mesh": {"file": "square.gltf"}})",
        R"("material": {"shininess": 7, "cull": "front"}, )");
    ASSERT_EQ(scene.objects.size(), 5u);
    EXPECT_EQ(scene.objects[1].name, "ball");
    const auto worn = [&](std::size_t i) { return scene.materials[scene.objects[i].material]; };
    EXPECT_EQ(worn(1).name, "default");
    EXPECT_TRUE(worn(1).textures.empty()) << "a file's defaults are its own objects'";
    EXPECT_EQ(worn(2).name, "default: brass (0)") << "the same name in another file";
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_FLOAT_EQ(worn(i).shininess, 7);
        EXPECT_EQ(worn(i).cull, Cull::front);
    }
    EXPECT_EQ(scene.objects[3].name, "object 0: brass");
}

TEST_F(SeveralGltfMaterials, ANamedMeshBecomesItsParts) {
    const std::string meshes = R"("meshes": {"row": {"file": "row.glb", "normals": "flat"}}, )";
    EXPECT_EQ(row_scene(R"({"mesh": "row"})", meshes).meshes.size(), 3u);
    EXPECT_EQ(
        row_scene(R"({"mesh": "row"}, {"mesh": "row", "transform": [{"translate": [0, 1, 0]}]})",
                  meshes)
            .meshes.size(),
        3u);
}

/// Images in the buffer of a .glb and in the text of a .gltf: the pixels of the file that they
/// were.
TEST_F(GltfMaterials, ImagesWithinTheFileAreRead) {
    Picture picture(8, 4, 0);
    for (int i = 0; i < 32; ++i)
        picture.set(i % 8, i / 8, static_cast<std::uint8_t>(i * 7), static_cast<std::uint8_t>(i),
                    90);
    write_png(folder / "base.png", picture);
    images[0] = {{"uri", "base.png"}};
    material.erase("normalTexture");
    const std::string expected = film_hash(render(scene_of(), {}));
    const std::string bytes = testing_films::file_bytes(folder / "base.png");

    images[0] = {{"uri", "data:image/png;base64," + base64(bytes)}, {"name", "paint"}};
    const Scene within = scene_of();
    EXPECT_EQ(within.materials.at(0).textures.at("color").selection.part, "0");
    EXPECT_EQ(film_hash(render(within, {})), expected);

    GltfBuilder builder = square_gltf();
    const int view =
        builder.add(std::vector<char>(bytes.begin(), bytes.end()), 5121, "SCALAR", bytes.size());
    builder.json["images"] = json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
    testing_films::write_bytes(folder / "box.glb", builder.binary());
    const Image read = load_image(folder / "box.glb");
    EXPECT_EQ(read.values, load_image(folder / "base.png").values);
    testing_films::write_bytes(folder / "box.gltf", builder.text("box.bin"));
    EXPECT_THROW(load_image(folder / "box.gltf"), InputError) << "that is another file";

    for (const char* const part : {"1", "paint"}) {
        try {
            load_image(folder / "box.glb", NotFinite::refuse, "material.color", {"", part});
            ADD_FAILURE() << part;
        } catch (const InputError& error) {
            EXPECT_EQ(error.key, "material.color");
            EXPECT_NE(error.found.find(part), std::string::npos) << error.what();
        }
    }
    builder.json["bufferViews"][static_cast<std::size_t>(view)]["byteLength"] = 1u << 30;
    testing_films::write_bytes(folder / "box.glb", builder.binary());
    EXPECT_THROW(load_image(folder / "box.glb"), InputError);
}

}  // namespace
}  // namespace quadrel
