#include "quadrel/scene/load.hpp"

#include "effort.hpp"
#include "io/scene/find_scene.hpp"
#include "scene/support.hpp"

namespace quadrel {
namespace {

class LoadScene : public testing::Test {
  protected:
    /// A scene of the given members after the version.
    Scene load(const std::string& members, const std::vector<std::string>& overrides = {}) const {
        const std::string comma = members.empty() ? "" : ",\n";
        return load_scene(folder.write("scene.json", "{\"quadrel\": 1" + comma + members + "}"),
                          overrides);
    }
    Scene load_text(const std::string& text) const {
        return load_scene(folder.write("scene.json", text));
    }
    testing::AssertionResult refuses(const std::string& members, const Complaint& complaint) const {
        return complains([&] { load(members); }, complaint);
    }
    testing::AssertionResult refuses_text(const std::string& text,
                                          const Complaint& complaint) const {
        return complains([&] { load_text(text); }, complaint);
    }

    TemporaryFolder folder;
};

TEST_F(LoadScene, DefaultsOfAnEmptyScene) {
    const Scene scene = load("");
    EXPECT_EQ(scene.width, 512);
    EXPECT_EQ(scene.samples, 1);
    EXPECT_TRUE(scene.objects.empty());
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "default");
    EXPECT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(load(R"("lights": [])").lights.size(), 0u);
}

TEST_F(LoadScene, ReadsEverySetting) {
    const Scene scene = load(R"("size": [64, 32], "samples": 4, "shade_at": "centroid",
        "conventions": "vulkan", "hardware": "llvmpipe", "derivatives": "coarse",
        "background": [1, 0.5, 0.25])");
    EXPECT_EQ(scene.width, 64);
    EXPECT_EQ(scene.height, 32);
    EXPECT_EQ(scene.samples, 4);
    EXPECT_TRUE(scene.centroid);
    EXPECT_EQ(scene.conventions, Conventions::vulkan);
    EXPECT_EQ(scene.hardware, Hardware::llvmpipe);
    EXPECT_EQ(scene.derivatives, DerivativeMode::coarse);
    EXPECT_EQ(scene.background, glm::vec4(1, 0.5, 0.25, 0));
}

TEST_F(LoadScene, CommentsAreAllowedAndNumbersOfAnyForm) {
    const Scene scene =
        load_text("// first\n{\"quadrel\": 1, /* here */ \"size\": [6.4e1, 32.0]}\n");
    EXPECT_EQ(scene.width, 64);
}

TEST_F(LoadScene, HeightsOfNoise) {
    const Scene scene = load(R"("materials": {
        "rough": {"height": {"noise": {"frequency": 6, "octaves": 3}}},
        "plain": {"height": {"noise": {}}}})");
    const Material& rough = scene.materials[scene.materials[0].name == "rough" ? 0 : 1];
    ASSERT_TRUE(rough.noise.has_value());
    EXPECT_EQ(rough.noise->frequency, 6);
    EXPECT_EQ(rough.noise->octaves, 3);
    EXPECT_TRUE(rough.textures.empty());
    EXPECT_TRUE(scene.materials[0].noise && scene.materials[1].noise);
    const auto in_material = [](const std::string& members) {
        return "\"materials\": {\"m\": {" + members + "}}";
    };
    EXPECT_TRUE(refuses(in_material(R"("height": {"noise": {"octaves": 11}})"),
                        {"materials.m.height.noise.octaves", "11", "[1, 10]"}));
    EXPECT_TRUE(refuses(in_material(R"("height": {"noise": {"frequency": 0}})"),
                        {"materials.m.height.noise.frequency", "0", ""}));
    EXPECT_TRUE(refuses(in_material(R"("height": {"noise": {}, "wrap": "repeat"})"),
                        {"materials.m.height.wrap", "does not take", ""}));
    EXPECT_TRUE(
        refuses(in_material(R"("color": {"noise": {}})"), {"materials.m.color", "file", ""}));
}

TEST_F(LoadScene, MaterialsTexturesAndStages) {
    folder.write("h.exr", "not decoded here");
    const Scene scene = load(R"(
        "hardware": "d3d",
        "textures": {"t": {"file": "h.exr", "wrap": ["repeat", "mirror-once"], "swizzle": "1-rg01",
                           "min": "nearest-mipmap-linear", "format": "unorm16", "border": [1,2,3]}},
        "materials": {"stone": {"height": "t", "color": {"file": "h.exr"},
            "relief": {"frame": {"id": "frame-gram", "flip": 1}, "trace": "linear", "steps": 128,
                       "depth": 0.25, "seat": 0.5},
            "shade": "shade-thesis", "cull": "back",
            "texture_matrix": {"scale": [2, 3], "rotate": 90, "offset": [5, 7]}}})");
    ASSERT_EQ(scene.materials.size(), 1u);
    const Material& stone = scene.materials[0];
    EXPECT_EQ(stone.name, "stone");
    EXPECT_EQ(stone.frame.id, "frame-gram");
    EXPECT_EQ(stone.frame.parameters.at("flip"), 1);
    EXPECT_EQ(stone.trace.id, "linear");
    EXPECT_EQ(stone.trace.parameters.at("steps"), 128);
    EXPECT_EQ(stone.trace.key, "materials.stone.relief.trace");
    EXPECT_TRUE(stone.surface.id.empty());
    EXPECT_EQ(stone.depth, 0.25f);
    EXPECT_EQ(stone.seat, 0.5f);
    EXPECT_EQ(stone.cull, Cull::back);
    const TextureReference& height = stone.textures.at("height");
    EXPECT_EQ(height.key, "textures.t");
    EXPECT_EQ(height.sampler.wrap_u, Wrap::repeat);
    EXPECT_EQ(height.sampler.wrap_v, Wrap::mirror_once);
    EXPECT_EQ(height.sampler.min, Filter::nearest);
    EXPECT_EQ(height.sampler.mip, MipFilter::linear);
    EXPECT_EQ(height.format, TexelFormat::unorm16);
    EXPECT_EQ(height.sampler.weight_bits, 8);
    EXPECT_EQ(stone.textures.at("color").key, "materials.stone.color");
    // (1, 0): scaled to (2, 0), turned to (0, 2), moved to (5, 9).
    EXPECT_EQ(stone.texture_matrix * glm::vec4(1, 0, 0, 1), glm::vec4(5, 9, 0, 1));
}

/// The image of the point (1, 0, 0) under a transform written as steps, applied in their order.
testing::AssertionResult moves_to(const Scene& scene, const glm::vec3& expected) {
    const glm::vec4 at = scene.objects.at(0).transform * glm::vec4(1, 0, 0, 1);
    if (glm::vec3(at) == expected) return testing::AssertionSuccess();
    return testing::AssertionFailure() << at.x << " " << at.y << " " << at.z;
}

TEST_F(LoadScene, TransformStepsApplyInOrder) {
    const auto with = [&](const std::string& transform) {
        return load(R"("objects": [{"mesh": "quad", "transform": )" + transform + "}]");
    };
    const std::string move = R"({"translate": [1, 2, 3]})";
    const std::string turn = R"({"rotate": 90, "axis": [0, 0, 1]})";
    EXPECT_TRUE(moves_to(with("[" + turn + "," + move + "]"), {1, 3, 3}));
    EXPECT_FALSE(moves_to(with("[" + move + "," + turn + "]"), {1, 3, 3}));  // steps_in_reverse
    EXPECT_TRUE(moves_to(with(R"([{"scale": 2}, {"scale": [3, 1, 1]}])"), {6, 0, 0}));
    EXPECT_TRUE(moves_to(with("[0,0,1,4, 2,0,0,5, 0,1,0,6, 0,0,0,1]"), {4, 7, 6}));
    EXPECT_TRUE(moves_to(with("[]"), {1, 0, 0}));
}

TEST_F(LoadScene, EqualMeshesAreLoadedOnce) {
    const Scene scene = load(R"("meshes": {"ball": {"shape": "sphere", "slices": 5, "stacks": 4}},
        "objects": [{"mesh": "quad"}, {"mesh": "ball"}, {"mesh": "quad"}, {"mesh": "ball"},
                    {"mesh": {"shape": "cube", "size": 3}}, {"mesh": {"shape": "cube", "size": 3}}])");
    EXPECT_EQ(scene.meshes.size(), 3u);
    EXPECT_EQ(scene.objects[1].mesh, scene.objects[3].mesh);
    EXPECT_EQ(scene.objects[4].mesh, scene.objects[5].mesh);
    EXPECT_EQ(scene.meshes[scene.objects[1].mesh].name, "ball");
}

TEST_F(LoadScene, CanonicalFormIgnoresOrderCommentsAndPaths) {
    folder.write("a.exr", "same");
    folder.write("b.exr", "same");
    folder.write("c.exr", "other");
    const Scene a = load(R"("size": [8, 4], "material": {"height": {"file": "a.exr"}})");
    const Scene b = load(R"(/**/ "material": {"height": {"file": "b.exr"}}, "size": [8.0, 4])");
    const Scene c = load(R"("size": [8, 4], "material": {"height": {"file": "c.exr"}})");
    EXPECT_EQ(a.canonical, b.canonical);
    EXPECT_EQ(a.hash, b.hash);
    EXPECT_EQ(a.hash.size(), 64u);
    EXPECT_NE(a.hash, c.hash);
    EXPECT_EQ(a.canonical.find("exr"), std::string::npos);
    EXPECT_NE(
        a.hash,
        load(R"("size": [8, 4], "material": {"height": {"file": "a.exr"}})", {"size[0]=9"}).hash);
}

// ---- What is refused

TEST_F(LoadScene, SyntaxErrorsGiveLineAndColumn) {
    EXPECT_TRUE(refuses_text("{\"quadrel\": 1,\n \"size\": [1, 2}", {"", "'}'", "", 2}));
    EXPECT_TRUE(refuses_text("", {"", "", ""}));
    EXPECT_TRUE(refuses_text("{\"quadrel\": 1} x", {"", "", "", 1}));
    EXPECT_TRUE(
        refuses_text("{\"quadrel\": 1, \"size\": [1e999, 1]}", {"size[0]", "1e999", "float64"}));
    EXPECT_TRUE(refuses_text(std::string(200, '['), {"", "nested", ""}));
    try {
        load_text("{\n  \"quadrel\": 1,,\n}");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.line, 2);
        EXPECT_EQ(error.column, 16);
    }
}

TEST_F(LoadScene, VersionComesFirst) {
    EXPECT_TRUE(refuses_text("{}", {"", "empty", "quadrel"}));
    EXPECT_TRUE(refuses_text("[]", {"", "array", "object"}));
    EXPECT_TRUE(refuses_text("{\"size\": [1, 1], \"quadrel\": 1}", {"size", "first", "quadrel"}));
    EXPECT_TRUE(refuses_text("{\"quadrel\": 2}", {"quadrel", "2", "1"}));
}

TEST_F(LoadScene, DuplicateAndUnknownKeys) {
    EXPECT_TRUE(refuses("\"size\": [1, 1],\n \"size\": [2, 2]", {"size", "second", "once", 3}));
    EXPECT_TRUE(refuses(R"("sise": [1, 1])", {"sise", "unknown", "\"size\""}));
    EXPECT_TRUE(refuses("\"camera\": {\n\"fov\": 3}", {"camera.fov", "unknown", "\"fov_y\"", 3}));
    EXPECT_TRUE(refuses(R"("material": {"relief": {"trcae": "linear"}})",
                        {"material.relief.trcae", "unknown", "\"trace\""}));
    EXPECT_TRUE(refuses(R"("lights": [{}, {"positoin": [1, 2, 3]}])",
                        {"lights[1].positoin", "unknown", "\"position\""}));
}

TEST_F(LoadScene, TypesAndRanges) {
    EXPECT_TRUE(refuses(R"("size": [0, 1])", {"size[0]", "0", "[1, 65536]"}));
    EXPECT_TRUE(refuses(R"("size": [1.5, 1])", {"size[0]", "1.5", "integer"}));
    EXPECT_TRUE(refuses(R"("size": [1, 65537])", {"size[1]", "65537", "65536"}));
    EXPECT_TRUE(refuses(R"("size": 64)", {"size", "64", "array of 2"}));
    EXPECT_TRUE(refuses(R"("samples": 3)", {"samples", "3", "1, 2, 4, 8 or 16"}));
    EXPECT_TRUE(refuses(R"("samples": "4")", {"samples", "\"4\"", "integer"}));
    EXPECT_TRUE(refuses(R"("background": [1, 2])", {"background", "array of 2", "3 to 4"}));
    EXPECT_TRUE(refuses(R"("background": [1, 2, null])", {"background[2]", "null", "number"}));
    EXPECT_TRUE(refuses(R"("background": [1, 2, 1e39])", {"background[2]", "1e+39", "float32"}));
    EXPECT_TRUE(refuses(R"("hardware": "d3d12")", {"hardware", "d3d12", "\"d3d\""}));
    EXPECT_TRUE(refuses(R"("material": {"relief": {"depth": -1}})",
                        {"material.relief.depth", "-1", "[0, "}));
    EXPECT_TRUE(refuses(R"("material": {"relief": {"seat": 1.5}})",
                        {"material.relief.seat", "1.5", "[0, 1]"}));
    EXPECT_TRUE(
        refuses(R"("material": {"relief": {"trace": 3}})", {"material.relief.trace", "3", "id"}));
    EXPECT_TRUE(refuses(R"("material": 3)", {"material", "3", "object"}));
    EXPECT_TRUE(refuses(R"("objects": {})", {"objects", "object", "array"}));
    EXPECT_TRUE(refuses(R"("lights": [{"type": "directional"}])",
                        {"lights[0]", "direction_to_light", "no default"}));
    EXPECT_TRUE(refuses(R"("lights": [{"type": "directional", "direction_to_light": [0, 0, 0]}])",
                        {"lights[0].direction_to_light", "array", "length"}));
    EXPECT_TRUE(refuses(R"("lights": [{"direction_to_light": [0, 0, 1]}])",
                        {"lights[0].direction_to_light", "point light", "left out"}));
}

TEST_F(LoadScene, Cameras) {
    const auto camera = [&](const std::string& members, const Complaint& complaint) {
        return refuses("\"camera\": {" + members + "}", complaint);
    };
    EXPECT_TRUE(camera(R"("fov_y": 180)", {"camera.fov_y", "180", "(0, 180)"}));
    EXPECT_TRUE(camera(R"("near": 0)", {"camera.near", "0", "> 0"}));
    EXPECT_TRUE(camera(R"("near": 5, "far": 5)", {"camera.near", "5", "near < far"}));
    EXPECT_TRUE(camera(R"("eye": [0, 2, 0])", {"camera", "line of sight", "direction"}));
    EXPECT_TRUE(camera(R"("up": [0, 0, 0])", {"camera", "line of sight", "direction"}));
    EXPECT_TRUE(camera(R"("eye": [1, 2, 3], "target": [1, 2, 3])", {"camera", "same place", ""}));
    EXPECT_TRUE(
        camera(R"("type": "orthographic", "far": "infinite")", {"camera.far", "infinite", ""}));
    EXPECT_TRUE(camera(R"("type": "orthographic", "fov_y": 50)",
                       {"camera.fov_y", "orthographic", "left out"}));
    const std::string zeros = "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]";
    const std::string ones = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
    const std::string matrices = R"("type": "matrices", "view": )" + ones + ", \"projection\": ";
    EXPECT_TRUE(camera(matrices + zeros, {"camera.projection", "singular", "inverse"}));
    EXPECT_TRUE(camera(matrices + "[1]", {"camera.projection", "array of 1", "16"}));
    EXPECT_EQ(load("\"camera\": {" + matrices + ones + "}").camera.view, glm::mat4(1.0f));
    EXPECT_TRUE(load(R"("camera": {"reversed_z": true, "far": "infinite"})").camera.reversed_z);
}

TEST_F(LoadScene, ObjectsAndTransforms) {
    const auto object = [&](const std::string& members, Complaint complaint) {
        return refuses("\"objects\": [{" + members + "}]", complaint);
    };
    EXPECT_TRUE(object("", {"objects[0]", "mesh", "no default"}));
    EXPECT_TRUE(object(R"("mesh": "qaud")", {"objects[0].mesh", "qaud", "\"quad\""}));
    EXPECT_TRUE(
        object(R"("mesh": {"shape": "qaud"})", {"objects[0].mesh.shape", "qaud", "\"quad\""}));
    EXPECT_TRUE(object(R"("mesh": {})", {"objects[0].mesh", "nothing", "shape"}));
    EXPECT_TRUE(object(R"("mesh": {"shape": "cube", "radius": 1})",
                       {"objects[0].mesh.radius", "shape cube", ""}));
    EXPECT_TRUE(object(R"("mesh": {"shape": "sphere", "slices": 2})",
                       {"objects[0].mesh.slices", "2", "[3, 2048]"}));
    EXPECT_TRUE(object(R"("mesh": "quad", "material": "ston")",
                       {"objects[0].material", "ston", "default"}));
    const std::string transform = R"("mesh": "quad", "transform": )";
    EXPECT_TRUE(object(transform + R"([{"rotate": 3}])",
                       {"objects[0].transform[0]", "axis", "no default"}));
    EXPECT_TRUE(object(transform + R"([{"rotate": 3, "axis": [0, 0, 0]}])",
                       {"objects[0].transform[0].axis", "array", "length"}));
    EXPECT_TRUE(object(transform + R"([{"scale": [1, 0, 1]}])",
                       {"objects[0].transform[0].scale", "array", "other than 0"}));
    EXPECT_TRUE(object(transform + R"([{"scale": 2, "translate": [1, 1, 1]}])",
                       {"objects[0].transform[0].scale", "step", ""}));
    EXPECT_TRUE(object(transform + "[1,0,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]",
                       {"objects[0].transform", "singular", "inverse"}));
    EXPECT_TRUE(object(transform + "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]",
                       {"objects[0].transform", "last row", "affine"}));
}

TEST_F(LoadScene, FilesAndTextures) {
    folder.write("h.exr", "x");
    EXPECT_TRUE(
        complains([&] { load_scene(folder.path() / "none.json"); }, {"", "no such file", ""}));
    EXPECT_TRUE(complains([&] { load_scene(folder.path() / "."); }, {"", "directory", ""}));
    const auto texture = [&](const std::string& members, Complaint complaint) {
        return refuses("\"textures\": {\"t\": {" + members + "}}", complaint);
    };
    EXPECT_TRUE(texture("", {"textures.t", "file", "no default"}));
    EXPECT_TRUE(texture(R"("file": "no.exr")", {"textures.t.file", "no.exr", "file"}));
    EXPECT_TRUE(texture(R"("file": ".")", {"textures.t.file", "directory", "file"}));
    const std::string file = R"("file": "h.exr", )";
    EXPECT_TRUE(texture(file + R"("swizzle": "xyz")", {"textures.t.swizzle", "xyz", "1-r"}));
    EXPECT_TRUE(texture(file + R"("swizzle": "rgbar")", {"textures.t.swizzle", "rgbar", "1 to 4"}));
    EXPECT_TRUE(
        texture(file + R"("wrap": "clamp")", {"textures.t.wrap", "clamp", "clamp-to-edge"}));
    EXPECT_TRUE(texture(file + R"("lod_min": 2, "lod_max": 1)", {"textures.t", "lod_min", ""}));
    EXPECT_TRUE(
        refuses(R"("textures": {"bricks": {"file": "h.exr"}}, "material": {"height": "brikcs"})",
                {"material.height", "brikcs", "\"bricks\""}));
    EXPECT_TRUE(refuses(R"("environment": {"faces": ["h.exr"]})",
                        {"environment.faces", "array of 1", "6"}));
    EXPECT_TRUE(
        refuses(R"("environment": {"faces": ["h.exr","h.exr","h.exr","h.exr","h.exr","n.exr"]})",
                {"environment.faces[5]", "n.exr", "file"}));
    const auto face = [&](const std::string& members, const Complaint& complaint) {
        return refuses(R"("environment": {"faces": [{)" + members +
                           R"(},"h.exr","h.exr","h.exr","h.exr","h.exr"]})",
                       complaint);
    };
    EXPECT_TRUE(face(R"("part": 0)", {"environment.faces[0]", "no \"file\"", ""}));
    EXPECT_TRUE(face(R"("file": "n.exr")", {"environment.faces[0].file", "n.exr", "file"}));
    EXPECT_TRUE(face(R"("file": "h.exr", "part": -1)",
                     {"environment.faces[0].part", "-1", "number from 0"}));
    EXPECT_TRUE(
        face(R"("file": "h.exr", "prat": 1)", {"environment.faces[0].prat", "", "\"part\""}));
}

TEST_F(LoadScene, TexturesNeedCoordinates) {
    folder.write("h.exr", "x");
    folder.write("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string object = R"(, "objects": [{"mesh": {"file": "bare.obj"}}])";
    EXPECT_TRUE(refuses(R"("material": {"color": {"file": "h.exr"}})" + object,
                        {"objects[0].mesh", "without texture coordinates", "default"}));
    EXPECT_EQ(load(R"("material": {})" + object).meshes.size(), 1u);
}

TEST_F(LoadScene, InstalledScenesAreFoundByName) {
    const auto names = installed_scenes();
    int row = 0;
    for (const std::string& name : names)
        if (test::is_tried(row++)) {
            EXPECT_NO_THROW(load_scene(name)) << name;
        }
    EXPECT_TRUE(
        complains([] { load_scene("thesis-qaud"); }, {"", "no installed scene", "thesis-quad"}));
}

TEST_F(LoadScene, DescriptionsAreTheCommentsThatFilesBeginWith) {
    for (const std::string& name : installed_scenes())
        EXPECT_NE(scene_description(name), "") << name;
    EXPECT_EQ(leading_comment("// a\n//b  \n{\n// c\n", "//"), "a b");
    EXPECT_EQ(leading_comment("  // a\n//\n// b\r\n\n// c\n", "//"), "a b");
    EXPECT_EQ(leading_comment("{}", "//"), "");
    EXPECT_EQ(leading_comment("# a", "#"), "a");
    EXPECT_EQ(leading_comment("", "#"), "");
    EXPECT_EQ(scene_description("parallax.glib").substr(0, 12), "The scene of");
}

}  // namespace
}  // namespace quadrel
