#include "quadrel/scene/mesh_file.hpp"

#include "io/gltf/gltf_files.hpp"
#include "io/mesh/mesh_properties.hpp"
#include "quadrel/scene/shapes.hpp"
#include "scene/support.hpp"
#include "scene/triangulate.hpp"

namespace quadrel {
namespace {

class MeshFiles : public testing::Test {
  protected:
    Mesh obj(const std::string& text, std::optional<bool> flip_v = std::nullopt) const {
        return load_mesh(folder.write("m.obj", text), flip_v);
    }
    Mesh glb(const GltfBuilder& gltf) const {
        return load_mesh(folder.write("m.glb", gltf.binary()));
    }
    testing::AssertionResult obj_refused(const std::string& text,
                                         const Complaint& complaint) const {
        return complains([&] { obj(text); }, complaint);
    }
    testing::AssertionResult glb_refused(const GltfBuilder& gltf,
                                         const Complaint& complaint) const {
        return complains([&] { glb(gltf); }, complaint);
    }
    TemporaryFolder folder;
};

// ---- OBJ

const std::string square_obj =
    "# a square\nv 0 0 0\nv 1 0 0 1.0\r\nv 1 1 0\nv 0 1 0 0.5 0.5 0.5\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.25 0\nvn 0 0 1\ng name\nusemtl none\n";

TEST_F(MeshFiles, ObjWithEverything) {
    const Mesh mesh = obj(square_obj + "f 1/1/1 2/2/1 3/3/1 4/4/1\n");
    EXPECT_TRUE(is_consistent(mesh));
    EXPECT_TRUE(normals_agree(mesh));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.uvs[0], glm::vec2(0, 1));  // v = 0 is the last row
    EXPECT_EQ(mesh.uvs[3], glm::vec2(0, 0.75f));
}

TEST_F(MeshFiles, ObjFlipCanBeOverridden) {
    const std::string text = square_obj + "f 1/1 2/2 3/3\n";
    EXPECT_EQ(obj(text, false).uvs[0], glm::vec2(0, 0));
    EXPECT_EQ(obj(text, true).uvs[0], glm::vec2(0, 1));
    EXPECT_EQ(obj(text).uvs, obj(text, true).uvs);
}

TEST_F(MeshFiles, ObjNegativeIndicesContinuedLinesAndMissingNewline) {
    const Mesh a = obj(square_obj + "f -4/-4 \\\n -3/-3 -2/-2");
    const Mesh b = obj(square_obj + "f 1/1 2/2 3/3\n");
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.uvs, b.uvs);
    EXPECT_EQ(a.triangles, b.triangles);
}

TEST_F(MeshFiles, ObjVerticesAreSharedPerCorner) {
    const Mesh mesh = obj(square_obj + "vn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n");
    EXPECT_EQ(mesh.positions.size(), 5u);  // corner 1 twice: its normals differ
    EXPECT_TRUE(mesh.uvs.empty());
    EXPECT_FALSE(mesh.normals.empty());
}

TEST_F(MeshFiles, ObjNumbersAreRoundedCorrectly) {
    const Mesh mesh =
        obj("v 0.1 16777217 1e-46\nv +1.0000000596046448 -.5e1 0\nv 0 1 2\nf 1 2 3\n");
    EXPECT_EQ(mesh.positions[0], glm::vec3(0.1f, 16777216.0f, 0.0f));
    EXPECT_EQ(mesh.positions[1], glm::vec3(std::nextafter(1.0f, 2.0f), -5, 0));
}

TEST_F(MeshFiles, ObjMistakesNameTheLine) {
    EXPECT_TRUE(obj_refused("", {"", "no faces", "mesh"}));
    EXPECT_TRUE(obj_refused("v 0 0 0\n", {"", "no faces", "mesh"}));
    EXPECT_TRUE(obj_refused("v 0 0 0\nv 1 2\n", {"", "2 numbers", "3", 2}));
    EXPECT_TRUE(obj_refused("v 0 nan 0\n", {"", "nan", "finite", 1}));
    EXPECT_TRUE(obj_refused("v 0 1e39 0\n", {"", "1e39", "finite", 1}));
    EXPECT_TRUE(obj_refused("v 0 0x 0\n", {"", "0x", "finite", 1}));
    EXPECT_TRUE(obj_refused(square_obj + "f 1 2\n", {"", "face of 2", "3 to 1024", 13}));
    EXPECT_TRUE(obj_refused(square_obj + "f 1 2 5\n", {"", "index 5", "of the 4", 13}));
    EXPECT_TRUE(obj_refused(square_obj + "f 0 1 2\n", {"", "index 0", "4 so far", 13}));
    EXPECT_TRUE(obj_refused(square_obj + "f -5 1 2\n", {"", "index -5", "4 so far", 13}));
    EXPECT_TRUE(obj_refused(square_obj + "f 1/9 2/1 3/1\n", {"", "uv index 9", "", 13}));
    EXPECT_TRUE(obj_refused(square_obj + "f 1 2 x\n", {"", "\"x\"", "index", 13}));
    EXPECT_TRUE(complains([&] { load_mesh(folder.path() / "no.obj"); }, {"", "no such file", ""}));
    EXPECT_TRUE(complains([&] { load_mesh(folder.write("m.ply", "")); }, {"", ".ply", ".obj"}));
}

// ---- Polygons

double area_z(std::span<const glm::dvec3> corners, const std::array<std::size_t, 3>& t) {
    return cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]).z / 2;
}

/// Triangles of positive area that add up to the polygon's.
template <class Triangulate>
testing::AssertionResult covers(const Triangulate& cut, std::span<const glm::dvec3> corners,
                                double area) {
    const auto triangles = cut(corners);
    if (triangles.size() != corners.size() - 2) return testing::AssertionFailure() << "count";
    double sum = 0;
    for (const auto& t : triangles) {
        if (!(area_z(corners, t) > 0)) return testing::AssertionFailure() << "a turned triangle";
        sum += area_z(corners, t);
    }
    if (std::abs(sum - area) > 1e-12) return testing::AssertionFailure() << "area " << sum;
    return testing::AssertionSuccess();
}

std::vector<std::array<std::size_t, 3>> fan(std::span<const glm::dvec3> corners) {
    std::vector<std::array<std::size_t, 3>> triangles;
    for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({0, i - 1, i});
    return triangles;
}

TEST(Triangulate, ConvexAndConcavePolygons) {
    const std::vector<glm::dvec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(triangulate(square), fan(square));
    EXPECT_TRUE(covers(triangulate, square, 1));
    const std::vector<glm::dvec3> arrow = {{0, 0, 0}, {4, -1, 0}, {1, 0, 0}, {4, 1, 0}};
    const std::vector<glm::dvec3> comb = {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 1, 0},
                                          {3, 3, 0}, {2, 1, 0}, {1, 3, 0}};
    for (std::size_t start = 0; start < 7; ++start) {
        auto turned = comb;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(start),
                    turned.end());
        EXPECT_TRUE(covers(triangulate, turned, 9.5)) << start;
        auto dart = arrow;
        std::rotate(dart.begin(), dart.begin() + static_cast<std::ptrdiff_t>(start % 4),
                    dart.end());
        EXPECT_TRUE(covers(triangulate, dart, 1 * 0.5 * 2)) << start;
    }
    EXPECT_FALSE(covers(fan, comb, 9.5));  // Defect::fan_of_concave
    const std::vector<glm::dvec3> point(5, glm::dvec3(1));
    EXPECT_EQ(triangulate(point).size(), 3u);
}

// ---- glTF

TEST_F(MeshFiles, GlbWithEverything) {
    const Mesh mesh = glb(square_gltf());
    EXPECT_TRUE(is_consistent(mesh));
    EXPECT_TRUE(normals_agree(mesh));
    EXPECT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.uvs[3], glm::vec2(0, 0.25f));  // v = 0 is the first row: kept
    ASSERT_EQ(mesh.tangents.size(), 4u);
    EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(load_mesh(folder.path() / "m.glb", true).uvs[3], glm::vec2(0, 0.75f));
}

TEST_F(MeshFiles, GltfWithItsBufferInAFile) {
    const GltfBuilder gltf = square_gltf();
    folder.write("my data.bin", gltf.bytes);
    const auto file = folder.write("m.gltf", gltf.text("my%20data.bin"));
    EXPECT_EQ(load_mesh(file).positions, glb(gltf).positions);
    EXPECT_EQ(files_of_mesh(file),
              (std::vector<std::filesystem::path>{file, folder.path() / "my data.bin"}));
    EXPECT_EQ(files_of_mesh(folder.path() / "m.glb").size(), 1u);
}

TEST_F(MeshFiles, NodeTransformsMoveNormalsByTheInverseTransposed) {
    // Scaled by 4 along x and turned by 90 degrees about y: x becomes -z.
    const double h = 0.70710678118654752;
    const Mesh mesh = glb(square_gltf(
        {{"scale", {4, 1, 2}}, {"rotation", {0, h, 0, h}}, {"translation", {10, 0, 0}}}));
    EXPECT_TRUE(normals_agree(mesh));
    EXPECT_LT(length(glm::dvec3(mesh.positions[1]) - glm::dvec3(10, 0, -4)), 1e-6);
    EXPECT_LT(length(glm::dvec3(mesh.normals[0]) - glm::dvec3(1, 0, 0)), 1e-6);
    EXPECT_LT(length(glm::dvec3(mesh.tangents[0]) - glm::dvec3(0, 0, -1)), 1e-6);
}

TEST_F(MeshFiles, ShearedNodesKeepNormalsOnTheirTriangles) {
    // Columns x, y, z, offset; z' leans over x.
    const Mesh mesh =
        glb(square_gltf({{"matrix", {1, 0, 2, 0, 0, 1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 1}}}));
    const auto [a, b, c] = corners_of(mesh, mesh.triangles[0]);
    const glm::dvec3 face = normalize(cross(b - a, c - a));
    EXPECT_NEAR(std::abs(dot(face, glm::dvec3(mesh.normals[0]))), 1, 1e-6);
    EXPECT_TRUE(normals_agree(mesh));
}

TEST_F(MeshFiles, MirroringNodesTurnTheirTriangles) {
    const Mesh mesh = glb(square_gltf({{"scale", {-1, 1, 1}}}));
    EXPECT_TRUE(normals_agree(mesh));
    EXPECT_EQ(mesh.tangents[0].w, -1);
}

TEST_F(MeshFiles, NodesNest) {
    GltfBuilder gltf = square_gltf();
    gltf.json["nodes"] = nlohmann::json::parse(
        R"([{"children": [1, 2], "translation": [1, 0, 0]}, {"mesh": 0, "scale": [2, 2, 2]}, {"mesh": 0}])");
    const Mesh mesh = glb(gltf);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(3, 2, 0));
    EXPECT_EQ(mesh.positions[6], glm::vec3(2, 1, 0));
}

TEST_F(MeshFiles, StripsFansAndNoIndices) {
    GltfBuilder strip;
    const int zigzag = strip.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 3);
    strip.set_primitive({{"attributes", {{"POSITION", zigzag}}}, {"mode", 5}});
    GltfBuilder fan_file;
    const int round = fan_file.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    fan_file.set_primitive({{"attributes", {{"POSITION", round}}}, {"mode", 6}});
    for (const auto& [file, count, area] :
         {std::tuple{&strip, 3u, 1.5}, std::tuple{&fan_file, 2u, 1.0}}) {
        const Mesh mesh = glb(*file);
        EXPECT_TRUE(mesh.normals.empty());
        EXPECT_TRUE(mesh.uvs.empty());
        ASSERT_EQ(mesh.triangles.size(), count);
        double sum = 0;
        for (const auto& triangle : mesh.triangles) {
            const auto [a, b, c] = corners_of(mesh, triangle);
            EXPECT_GT(cross(b - a, c - a).z, 0);
            sum += cross(b - a, c - a).z / 2;
        }
        EXPECT_DOUBLE_EQ(sum, area);
    }
}

TEST_F(MeshFiles, NormalisedAndSparseAttributes) {
    GltfBuilder gltf = square_gltf();
    const int uvs =
        gltf.add<std::uint16_t>({0, 65535, 65535, 65535, 65535, 0, 0, 0}, 5123, "VEC2", 4);
    gltf.json["accessors"][uvs]["normalized"] = true;
    gltf.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uvs;
    const int at = gltf.shorts({2});
    const int moved = gltf.floats({7, 8, 9}, "VEC3", 3);
    gltf.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", gltf.json["accessors"][at]["bufferView"]}, {"componentType", 5123}}},
        {"values", {{"bufferView", gltf.json["accessors"][moved]["bufferView"]}}}};
    const Mesh mesh = glb(gltf);
    EXPECT_EQ(mesh.uvs[1], glm::vec2(1, 1));
    EXPECT_EQ(mesh.positions[2], glm::vec3(7, 8, 9));
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
}

TEST_F(MeshFiles, GltfMistakesAreFound) {
    const auto broken = [&](const auto& change) {
        GltfBuilder gltf = square_gltf();
        change(gltf.json);
        return gltf;
    };
    using nlohmann::json;
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["accessors"][0]["count"] = 5; }),
                            {"accessors[0]", "5 elements", "buffer view"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["accessors"][4]["bufferView"] = 1; }),
                            {"meshes[0].primitives[0].indices", "vertex", "below 4"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["bufferViews"][0]["byteLength"] = 100000; }),
                            {"bufferViews[0]", "past", "bytes"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["bufferViews"][0]["buffer"] = 3; }),
                            {"bufferViews[0]", "buffer 3", "one of the 1"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["accessors"][0]["bufferView"] = 77; }),
                            {"accessors[0]", "77", "one of"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["accessors"][0]["type"] = "VEC2"; }),
                            {"accessors[0]", "another type", "3 floats"}));
    EXPECT_TRUE(glb_refused(
        broken([](json& j) { j["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }),
        {"meshes[0].primitives[0]", "POSITION", "positions"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["nodes"][0]["children"] = {0}; }),
                            {"nodes[0]", "below itself", "tree"}));
    EXPECT_TRUE(glb_refused(broken([](json& j) { j["meshes"][0]["primitives"][0]["mode"] = 1; }),
                            {"", "no triangles", "mesh"}));
    EXPECT_TRUE(glb_refused(
        broken([](json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
        {"extensionsRequired", "draco", ""}));
}

TEST_F(MeshFiles, GltfThatIsCutOffOrMissing) {
    const std::string whole = square_gltf().binary();
    for (std::size_t size : {0u, 3u, 12u, 19u, 100u}) {
        folder.write("cut.glb", whole.substr(0, size));
        EXPECT_TRUE(complains([&] { load_mesh(folder.path() / "cut.glb"); }, {"", "", "glTF"}))
            << size;
    }
    folder.write("cut.glb", whole.substr(0, whole.size() - 8));
    EXPECT_THROW(load_mesh(folder.path() / "cut.glb"), InputError);
    const auto lonely = folder.write("lonely.gltf", square_gltf().text("absent.bin"));
    EXPECT_TRUE(complains([&] { load_mesh(lonely); }, {"buffers[0].uri", "absent.bin", "a file"}));
    EXPECT_TRUE(complains([&] { load_mesh(folder.path() / "no.glb"); }, {"", "no such file", ""}));
}

TEST_F(MeshFiles, GltfNumbersMustBeFinite) {
    GltfBuilder gltf = square_gltf();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(gltf.bytes.data() + 4, &nan, 4);
    EXPECT_TRUE(glb_refused(gltf, {"accessors[0]", "NaN in element 0", "finite"}));
    const float infinity = -std::numeric_limits<float>::infinity();
    std::memcpy(gltf.bytes.data() + 4, &infinity, 4);
    EXPECT_TRUE(glb_refused(gltf, {"accessors[0]", "-infinity in element 0", "finite"}));
    gltf = square_gltf();
    std::string text = gltf.text("m.bin");
    folder.write("m.bin", gltf.bytes);
    text.replace(text.find("\"mesh\":0"), 8, "\"mesh\":0,\"scale\":[1,-Infinity,1]");
    const auto file = folder.write("m.gltf", text);
    EXPECT_TRUE(complains([&] { load_mesh(file); }, {"", "-Infinity", "finite"}));
}

}  // namespace
}  // namespace quadrel
