// Materials of glTF files as defaults of a scene's: what is taken, what a scene's own keys win
// over, what is left and said.
#include <gtest/gtest.h>

#include "film/films.hpp"
#include "io/gltf/gltf_files.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

/// A square of one material, and a scene of it.
class GltfMaterials : public testing::Test {
  protected:
    GltfMaterials() {
        for (const char* const name : {"base.exr", "bumps.exr", "own.exr"})
            write_exr(folder / name, testing_films::smooth_film(1, {0, 0, 16, 9}), {});
        material = {{"name", "brass"},
                    {"doubleSided", true},
                    {"pbrMetallicRoughness",
                     {{"baseColorTexture", {{"index", 0}}},
                      {"metallicFactor", 0},
                      {"roughnessFactor", 0.5}}},
                    {"normalTexture", {{"index", 1}}}};
    }

    void write_mesh(std::size_t materials = 1) {
        GltfBuilder builder;
        const int positions = builder.floats({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3", 3);
        const int uvs = builder.floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
        const int indices = builder.shorts({0, 1, 2, 0, 2, 3});
        const json part = {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                           {"indices", indices},
                           {"material", 0}};
        builder.set_primitive(part);
        builder.json["materials"] = json::array({material});
        for (std::size_t i = 1; i < materials; ++i) {
            json other = part;
            other["material"] = i;
            builder.json["meshes"][0]["primitives"].push_back(other);
            builder.json["materials"].push_back(material);
        }
        builder.json["images"] = json::array({{{"uri", "base.exr"}}, {{"uri", "bumps.exr"}}});
        builder.json["samplers"] =
            json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}});
        builder.json["textures"] = json::array({{{"source", 0}, {"sampler", 0}}, {{"source", 1}}});
        testing_films::write_bytes(folder / "square.gltf", builder.text("square.bin"));
        testing_films::write_bytes(folder / "square.bin", builder.bytes);
    }

    Scene scene_of(const std::string& keys = "", const std::string& mesh = "",
                   std::size_t materials = 1) {
        write_mesh(materials);
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
    EXPECT_EQ(taken.shade.id, "shade-cook-torrance");
    EXPECT_FLOAT_EQ(taken.specular.x, 0.04f);
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
            "diffuse": [1, 1, 1, 1], "specular": [0.04, 0.04, 0.04, 1],
            "shade": {"id": "shade-cook-torrance", "roughness": 0.25},
            "relief": {"surface": {"id": "normal-map", "green": "down"}}}, )",
                                      R"(, "materials": false)"),
                             {});
    EXPECT_EQ(film_hash(taken), film_hash(said));
    const Film none = render(scene_of("", R"(, "materials": false)"), {});
    EXPECT_NE(film_hash(taken), film_hash(none));
}

TEST_F(GltfMaterials, TheScenesOwnKeysWin) {
    const Scene scene = scene_of(R"("material": {"color": {"file": "own.exr"},
        "height": {"file": "bumps.exr"}, "shade": "shade-lambert", "cull": "front"}, )");
    const Material& both = scene.materials.at(0);
    EXPECT_EQ(both.textures.at("color").file.filename(), "own.exr");
    EXPECT_FALSE(both.textures.contains("normal"));  // heights say what the normals are
    EXPECT_EQ(both.shade.id, "shade-lambert");
    EXPECT_FLOAT_EQ(both.specular.x, 0.04f);
}

TEST_F(GltfMaterials, MetalMirrorsItsColour) {
    material = {{"pbrMetallicRoughness", {{"baseColorFactor", {1.0, 0.5, 0.25, 1.0}}}},
                {"emissiveFactor", {0.5, 0.0, 0.0}},
                {"alphaMode", "MASK"},
                {"alphaCutoff", 0.25}};
    const Material metal = scene_of().materials.at(0);
    EXPECT_EQ(metal.diffuse, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(metal.specular, glm::vec4(1, 0.5f, 0.25f, 1));
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
    EXPECT_EQ(refused_at("/pbrMetallicRoughness/metallicFactor", 0.5), "nothing");
}

TEST_F(GltfMaterials, WhatIsLeftIsSaid) {
    material["occlusionTexture"] = {{"index", 0}};
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
    material["normalTexture"]["texCoord"] = 1;
    material["emissiveTexture"] = {
        {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2.0, 2.0}}}}}}};
    material["emissiveFactor"] = {1, 1, 1};
    const Scene scene = scene_of();
    for (const char* const part : {"occlusion (no map", "map of roughness", "normal (another set",
                                   "emission (another texture transform)"})
        EXPECT_NE(note_of(scene).find(part), std::string::npos) << note_of(scene);
    EXPECT_FALSE(scene.materials[0].textures.contains("normal"));
    EXPECT_FALSE(scene.materials[0].textures.contains("emissive"));
    std::filesystem::remove(folder / "base.exr");
    EXPECT_NE(note_of(scene_of()).find("base colour (no file"), std::string::npos);
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

TEST_F(GltfMaterials, OfSeveralNoneIsTaken) {
    const Scene scene = scene_of("", "", 2);
    EXPECT_TRUE(scene.materials.at(0).textures.empty());
    EXPECT_NE(note_of(scene).find("2 materials: taken: nothing; left: all"), std::string::npos)
        << note_of(scene);
}

}  // namespace
}  // namespace quadrel
