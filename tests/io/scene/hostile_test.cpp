// Files made to hurt: deep, endless, repetitive, unprintable. Found by fuzzing, or by thinking of
// it.
#include <sys/stat.h>

#include <thread>

#include "io/gltf/gltf_files.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "scene/support.hpp"
#include "scene/triangulate.hpp"

namespace quadrel {
namespace {

class Hostile : public testing::Test {
  protected:
    testing::AssertionResult scene_refused(const std::string& text,
                                           const Complaint& complaint) const {
        return complains([&] { load_scene(folder.write("s.json", text)); }, complaint);
    }
    testing::AssertionResult obj_refused(const std::string& text,
                                         const Complaint& complaint) const {
        return complains([&] { load_mesh(folder.write("m.obj", text)); }, complaint);
    }
    testing::AssertionResult gltf_refused(const std::string& text,
                                          const Complaint& complaint) const {
        return complains([&] { load_mesh(folder.write("m.gltf", text)); }, complaint);
    }
    TemporaryFolder folder;
};

/// Whether the message is one line that no terminal obeys.
testing::AssertionResult printable(const std::string& message) {
    for (const char c : message)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            return testing::AssertionFailure() << "character " << int{c};
    return testing::AssertionSuccess();
}

TEST_F(Hostile, MessagesStayOneLineOfBoundedLength) {
    const InputError error("a\nb", "k\x1b[2J", std::string("\0\r\x7f", 3), "x\ty", 1, 2);
    EXPECT_TRUE(printable(error.what()));
    EXPECT_STREQ(error.what(), "a b:1:2: k\\x1b[2J: found \\x00\\x0d\\x7f, expected x y");
    EXPECT_EQ(error.key, "k\x1b[2J") << "the parts stay as they are";
    EXPECT_FALSE(printable("a\nb"));
    EXPECT_TRUE(printable(OutputError("a\nb", "c\x1b").what()));
    EXPECT_LT(std::string(InputError("f", "k", std::string(100000, 'x'), "").what()).size(), 500u);
}

TEST_F(Hostile, JsonThatIsTooMuch) {
    EXPECT_TRUE(scene_refused(R"({"quadrel": 1, "a": )" + std::string(60, '[') + "}",
                              {"", "nested", "a scene"}));
    EXPECT_TRUE(scene_refused("{\"quadrel\": 1,\n\"" + std::string(201, 'k') + "\": 1}",
                              {"", "a key of 201 bytes", "200", 2}));
    EXPECT_TRUE(scene_refused(std::string(5 << 20, ' '), {"", "5242880 bytes", "at most"}));
}

/// Line and column are found without counting from the start each time.
TEST_F(Hostile, PositionsInLongFiles) {
    std::string text = "{\"quadrel\": 1, \"lights\": [";
    for (int i = 0; i < 100000; ++i) text += "\n{},";
    EXPECT_TRUE(
        scene_refused(text + "\n{\"x\": 1}]}", {"lights[100000].x", "an unknown key", "", 100002}));
    std::string keys = "{\"quadrel\": 1";
    for (int i = 1; i < 4096; ++i) keys += ",\n \"k" + std::to_string(i) + "\": 1";
    EXPECT_TRUE(scene_refused(keys + "}", {"k1", "an unknown key", "", 2}));
    EXPECT_TRUE(scene_refused(keys + ",\n\"k\": 1}", {"", "more than 4096 keys", "", 4097}));
}

TEST_F(Hostile, WhatIsNoFile) {
    const auto load = [](const char* name) { return [name] { load_scene(name); }; };
    EXPECT_TRUE(complains(load("/dev/zero"), {"", "a device", "a file"}));
    EXPECT_TRUE(complains(load("/dev"), {"", "a directory", "a file"}));
    EXPECT_TRUE(complains([] { load_scene(std::string(300, 'x')); }, {"", "no installed", ""}));
    EXPECT_TRUE(
        complains([] { load_scene(std::string(300, 'x') + ".glib"); }, {"", "no such", ""}));
    for (const char* name : {"/dev/zero", "/dev/stdin/x", "/dev"})
        EXPECT_TRUE(scene_refused(
            R"({"quadrel": 1, "textures": {"t": {"file": ")" + std::string(name) + "\"}}}",
            {"textures.t.file", name, "a file"}));
    ASSERT_EQ(mkfifo((folder.path() / "pipe.obj").c_str(), 0600), 0);
    EXPECT_TRUE(scene_refused(R"({"quadrel": 1, "objects": [{"mesh": {"file": "pipe.obj"}}]})",
                              {"objects[0].mesh.file", "a pipe", "a file"}));
}

TEST_F(Hostile, ASceneMayComeThroughAPipe) {
    const auto pipe = folder.path() / "scene.json";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { std::ofstream(pipe) << R"({"quadrel": 1, "size": [3, 5]})"; });
    EXPECT_EQ(load_scene(pipe).height, 5);
    writer.join();
}

// ---- Meshes

TEST_F(Hostile, PolygonsOfManyCorners) {
    const auto polygon = [](int corners) {
        std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf";
        for (int i = 0; i < corners; ++i) text += " " + std::to_string(i * 7 % 4 + 1);
        return text;
    };
    EXPECT_EQ(load_mesh(folder.write("m.obj", polygon(1024))).triangles.size(), 1022u);
    EXPECT_TRUE(obj_refused(polygon(1025), {"", "a face of 1025 corners", "3 to 1024"}));
}

/// Polygons that cross themselves have no ear at some time; then no more are looked for.
TEST_F(Hostile, PolygonsThatCrossThemselves) {
    std::vector<glm::dvec3> star;
    for (std::size_t i = 0; i < 1000; ++i) {
        const auto at = static_cast<double>(i * 499 % 1000);
        star.emplace_back(at, at * at / 1000, 0);
    }
    const auto triangles = triangulate(star);
    EXPECT_EQ(triangles.size(), 998u);
    std::vector<int> seen(1000);
    for (const auto& triangle : triangles)
        for (std::size_t corner : triangle) ++seen.at(corner);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), 0) << "every corner is used";
}

TEST_F(Hostile, GltfOfDeepBrackets) {
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_TRUE(gltf_refused(R"({"asset": {"version": "2.0", "extras": )" + deep + "}}",
                             {"", "nested", "glTF"}));
    // Brackets within strings do not count, escaped quotes do not end them.
    GltfBuilder gltf = square_gltf();
    gltf.json["extras"] = {{"note\"[", std::string(200, '[')}};
    EXPECT_EQ(load_mesh(folder.write("m.glb", gltf.binary())).triangles.size(), 2u);
    gltf.json["extras"] = nlohmann::json::parse(std::string(101, '[') + std::string(101, ']'));
    EXPECT_TRUE(complains([&] { load_mesh(folder.write("m.glb", gltf.binary())); },
                          {"", "more than 100 nested", "glTF"}));
}

GltfBuilder chain_of_nodes(int count) {
    GltfBuilder gltf = square_gltf();
    auto nodes = nlohmann::json::array();
    for (int i = 0; i + 1 < count; ++i) nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    gltf.json["nodes"] = nodes;
    return gltf;
}

TEST_F(Hostile, GltfOfDeepNodes) {
    const auto load = [&](int count) {
        return load_mesh(folder.write("m.glb", chain_of_nodes(count).binary()));
    };
    for (const int count : {1000, 5000}) EXPECT_EQ(load(count).triangles.size(), 2u) << count;
}

TEST_F(Hostile, GltfThatRepeatsItself) {
    GltfBuilder gltf;
    gltf.bytes = std::string(8, '\0');  // not used
    gltf.json["accessors"] = {{{"componentType", 5126}, {"count", 1 << 20}, {"type", "VEC3"}}};
    gltf.set_primitive({{"attributes", {{"POSITION", 0}}}});
    const auto refused = [&](const Complaint& complaint) {
        return complains([&] { load_mesh(folder.write("m.glb", gltf.binary())); }, complaint);
    };
    auto& primitives = gltf.json["meshes"][0]["primitives"];
    for (int i = 1; i < 33; ++i) primitives.push_back(primitives[0]);
    EXPECT_TRUE(refused({"", "34603008 vertices", "at most 33554432"}));
    gltf.json["accessors"][0]["count"] = (1 << 20) + 1;
    EXPECT_TRUE(refused({"accessors[0].count", "1048577", "2^20"}));
    gltf.json["accessors"][0]["count"] = 3;
    EXPECT_EQ(load_mesh(folder.write("m.glb", gltf.binary())).positions.size(), 99u);
}

TEST_F(Hostile, GltfBuffersAreFiles) {
    ASSERT_EQ(mkfifo((folder.path() / "pipe.bin").c_str(), 0600), 0);
    const GltfBuilder gltf = square_gltf();
    for (const char* uri : {"missing.bin", "pipe.bin", ".", "/dev/zero", "data:,x"})
        EXPECT_TRUE(gltf_refused(gltf.text(uri), {"buffers[0].uri", "", ""})) << uri;
    folder.write("short.bin", gltf.bytes.substr(1));
    EXPECT_TRUE(gltf_refused(gltf.text("short.bin"), {"buffers[0].byteLength", "", "at most"}));
    folder.write("whole.bin", gltf.bytes);
    EXPECT_EQ(load_mesh(folder.write("m.gltf", gltf.text("whole.bin"))).triangles.size(), 2u);
}

}  // namespace
}  // namespace quadrel
