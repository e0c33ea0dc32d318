// What glTF's geometry means: morph targets, skins, attributes by primitive, quantisation. Each
// reader that is wrong in one thing is imitated by the file that it takes the file for, and has to
// be caught.
#include <gtest/gtest.h>

#include "io/gltf/gltf_geometry.hpp"
#include "io/mesh/mesh_properties.hpp"
#include "scene/planted.hpp"

namespace quadrel {
namespace {

using nlohmann::json;
using planted::GltfDefect;

using Points = std::vector<glm::vec3>;

// ---- Morph targets

/// The square, 1 higher by its node. Targets: 0.5 upwards; leaning normals and turned tangents.
GltfBuilder morphed_square() {
    GltfBuilder gltf = square_gltf({{"translation", {0, 0, 1}}});
    const int lift = gltf.floats({0, 0, .5f, 0, 0, .5f, 0, 0, .5f, 0, 0, .5f}, "VEC3", 3);
    const int lean = gltf.floats({2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3", 3);
    const int turn = gltf.floats({-2, 2, 0, -2, 2, 0, -2, 2, 0, -2, 2, 0}, "VEC3", 3);
    primitive_of(gltf)["targets"] = {{{"POSITION", lift}}, {{"NORMAL", lean}, {"TANGENT", turn}}};
    gltf.json["meshes"][0]["weights"] = {1, 0.5};
    return gltf;
}

testing::AssertionResult is_morphed(const Mesh& mesh) {
    const float h = 0.70710678f;
    if (auto ok =
            near(mesh.positions, Points{{0, 0, 1.5f}, {1, 0, 1.5f}, {1, 1, 1.5f}, {0, 1, 1.5f}});
        !ok)
        return ok;
    if (auto ok = near(mesh.normals, Points(4, {h, 0, h})); !ok) return ok << ", a normal";
    return near(mesh.tangents, std::vector<glm::vec4>(4, {0, 1, 0, 1})) << ", a tangent";
}

TEST_F(GltfGeometry, DefaultWeightsAreUsed) {
    EXPECT_TRUE(is_morphed(mesh(morphed_square())));
    GltfBuilder by_node = morphed_square();
    by_node.json["nodes"][0]["weights"] = {1, 0.5};
    by_node.json["meshes"][0]["weights"] = {0, 0};
    EXPECT_TRUE(is_morphed(mesh(by_node)));
    for (const GltfDefect defect : {GltfDefect::weights_ignored, GltfDefect::mesh_weights_win,
                                    GltfDefect::normals_not_morphed}) {
        GltfBuilder gltf = by_node;
        if (defect == GltfDefect::weights_ignored) gltf.json["nodes"][0]["weights"] = {0, 0};
        if (defect == GltfDefect::mesh_weights_win) gltf.json["nodes"][0].erase("weights");
        if (defect == GltfDefect::normals_not_morphed) gltf.json["nodes"][0]["weights"] = {1, 0};
        EXPECT_FALSE(is_morphed(mesh(gltf))) << static_cast<int>(defect);
    }
}

TEST_F(GltfGeometry, WithoutWeightsTargetsRest) {
    GltfBuilder gltf = morphed_square();
    gltf.json["meshes"][0].erase("weights");
    EXPECT_EQ(mesh(gltf).normals, Points(4, {0, 0, 1}));
    EXPECT_EQ(mesh(gltf).positions[0], glm::vec3(0, 0, 1));
}

TEST_F(GltfGeometry, MorphedTextureCoordinates) {
    GltfBuilder gltf = square_gltf();
    const int shift = gltf.floats({.5f, 0, .5f, 0, .5f, 0, .5f, 0}, "VEC2", 2);
    primitive_of(gltf)["targets"] = json::array({{{"TEXCOORD_0", shift}}});
    gltf.json["meshes"][0]["weights"] = json::array({0.5});
    EXPECT_EQ(mesh(gltf).uvs[0], glm::vec2(0.25f, 1));
}

// ---- Skins

/// The square between two joints: the left corners belong to the first, the right ones to both. The
/// node of the mesh stands elsewhere.
GltfBuilder skinned_square() {
    GltfBuilder gltf = square_gltf();
    const int joints =
        gltf.add<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 4);
    const int weights =
        gltf.floats({1, 0, 0, 0, .5f, .5f, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    primitive_of(gltf)["attributes"]["JOINTS_0"] = joints;
    primitive_of(gltf)["attributes"]["WEIGHTS_0"] = weights;
    const std::vector<float> identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::vector<float> bind = identity;
    bind.insert(bind.end(), identity.begin(), identity.end());
    bind[29] = -1;  // the second joint's: 1 down
    const int matrices = gltf.floats(bind, "MAT4", 16);
    gltf.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                          {{"translation", {0, 0, 1}}, {"children", {2}}},
                          {{"translation", {1, 0, 0}}, {"scale", {2, 2, 2}}}};
    gltf.json["scenes"] = json::array({{{"nodes", {0, 1}}}});
    gltf.json["skins"] = json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}});
    return gltf;
}

// By hand: the second joint takes (x, y, 0) to (2 x + 1, 2 (y - 1), 1).
testing::AssertionResult is_skinned(const Mesh& mesh) {
    return near(mesh.positions, Points{{0, 0, 1}, {2, -1, 1}, {2, 0.5f, 1}, {0, 1, 1}});
}

TEST_F(GltfGeometry, JointsMoveASkinAndItsNodeDoesNot) {
    const Mesh skinned = mesh(skinned_square());
    EXPECT_TRUE(is_skinned(skinned));
    EXPECT_TRUE(near(skinned.normals, Points(4, {0, 0, 1})));
    EXPECT_TRUE(near(skinned.tangents, std::vector<glm::vec4>(4, {1, 0, 0, 1})));
    for (const GltfDefect defect :
         {GltfDefect::skin_ignored, GltfDefect::node_of_skin_applied,
          GltfDefect::inverse_bind_ignored, GltfDefect::first_joint_alone}) {
        GltfBuilder gltf = skinned_square();
        if (defect == GltfDefect::skin_ignored) gltf.json["nodes"][0].erase("skin");
        if (defect == GltfDefect::node_of_skin_applied)
            gltf.json["nodes"][1]["translation"] = {100, 0, 1};
        if (defect == GltfDefect::inverse_bind_ignored)
            gltf.json["skins"][0].erase("inverseBindMatrices");
        if (defect == GltfDefect::first_joint_alone) gltf.json["skins"][0]["joints"] = {1, 1};
        EXPECT_FALSE(is_skinned(mesh(gltf))) << static_cast<int>(defect);
    }
}

TEST_F(GltfGeometry, WeightsOfBytesAndOfTwoSets) {
    GltfBuilder gltf = skinned_square();
    auto& attributes = primitive_of(gltf)["attributes"];
    const int half = gltf.add<std::uint8_t>(
        {255, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 255, 0, 0, 0}, 5121, "VEC4", 4);
    const int rest = gltf.add<std::uint8_t>({0, 0, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 0, 0, 0},
                                            5121, "VEC4", 4);
    for (const int weights : {half, rest}) gltf.json["accessors"][weights]["normalized"] = true;
    attributes["WEIGHTS_0"] = half;
    attributes["JOINTS_1"] = attributes["JOINTS_0"];
    attributes["WEIGHTS_1"] = rest;
    EXPECT_TRUE(is_skinned(mesh(gltf))) << "sums of 254 / 255 are made 1";
}

TEST_F(GltfGeometry, MirroringJointsTurnTriangles) {
    GltfBuilder gltf = skinned_square();
    gltf.json["nodes"][1]["scale"] = {-1, 1, 1};
    EXPECT_TRUE(normals_agree(mesh(gltf)));
    gltf = skinned_square();
    gltf.json["nodes"][0]["scale"] = {-1, 1, 1};  // which is ignored
    EXPECT_TRUE(normals_agree(mesh(gltf)));
    EXPECT_TRUE(is_skinned(mesh(gltf)));
}

// ---- Attributes by primitive

/// Two squares of one mesh that share positions and indices; the second has no normals.
GltfBuilder two_primitives() {
    GltfBuilder gltf = square_gltf();
    const int leaning =
        gltf.floats({.6f, 0, .8f, .6f, 0, .8f, .6f, 0, .8f, .6f, 0, .8f}, "VEC3", 3);
    primitive_of(gltf)["attributes"]["NORMAL"] = leaning;
    json second = primitive_of(gltf);
    second["attributes"].erase("NORMAL");
    gltf.json["meshes"][0]["primitives"].push_back(second);
    return gltf;
}

testing::AssertionResult first_leans_second_is_flat(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const std::uint32_t v : mesh.triangles[t]) {
            const glm::vec3 n = mesh.normals.empty() ? glm::vec3(0, 0, 1) : mesh.normals[v];
            const glm::vec3 expected = t < 2 ? glm::vec3(.6f, 0, .8f) : glm::vec3(0, 0, 1);
            if (n != expected) return testing::AssertionFailure() << "of triangle " << t;
        }
    return testing::AssertionSuccess();
}

TEST_F(GltfGeometry, NormalsAreOfPrimitives) {
    const Mesh found = mesh(two_primitives());
    EXPECT_TRUE(is_consistent(found));
    ASSERT_EQ(found.triangles.size(), 4u);
    EXPECT_TRUE(first_leans_second_is_flat(found));
    GltfBuilder same = two_primitives(), none = two_primitives();
    primitive_of(same, 1) = primitive_of(same, 0);  // GltfDefect::normals_of_first_primitive
    EXPECT_FALSE(first_leans_second_is_flat(mesh(same)));
    primitive_of(none, 0) = primitive_of(none, 1);  // GltfDefect::normals_of_all_dropped
    EXPECT_FALSE(first_leans_second_is_flat(mesh(none)));
}

TEST_F(GltfGeometry, TangentsNeedNormals) {
    GltfBuilder gltf = square_gltf();
    const int turned = gltf.floats({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4", 4);
    primitive_of(gltf)["attributes"]["TANGENT"] = turned;
    EXPECT_EQ(mesh(gltf).tangents[0], glm::vec4(0, 1, 0, 1));
    json second = primitive_of(gltf);
    second["attributes"].erase("NORMAL");
    gltf.json["meshes"][0]["primitives"].push_back(second);
    // The first primitive's own; the second's made anew, dP/du.
    const Mesh both = mesh(gltf);
    EXPECT_TRUE(is_consistent(both));
    EXPECT_EQ(both.tangents[both.triangles[0][0]], glm::vec4(0, 1, 0, 1));
    const glm::vec4 made = both.tangents[both.triangles[2][0]];
    EXPECT_GT(made.x, 0.9f);
    EXPECT_EQ(made.w, 1);
    primitive_of(gltf, 0) = primitive_of(gltf, 1);
    EXPECT_TRUE(mesh(gltf).tangents.empty()) << "GltfDefect::tangents_without_normals";
}

TEST_F(GltfGeometry, PrimitivesWithoutTextureCoordinatesAreDegenerate) {
    GltfBuilder gltf = two_primitives();
    primitive_of(gltf, 1)["attributes"].erase("TEXCOORD_0");
    const Mesh found = mesh(gltf);
    EXPECT_EQ(found.uvs[found.triangles[0][1]], glm::vec2(1, 1));
    for (const std::uint32_t v : found.triangles[2]) EXPECT_EQ(found.uvs[v], glm::vec2(0, 0));
    primitive_of(gltf, 0)["attributes"].erase("TEXCOORD_0");
    EXPECT_TRUE(mesh(gltf).uvs.empty());
}

TEST_F(GltfGeometry, NullNormalsAreTheFaces) {
    GltfBuilder gltf = square_gltf();
    const int some = gltf.floats({0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 3);
    primitive_of(gltf)["attributes"]["NORMAL"] = some;
    const Mesh found = mesh(gltf);
    EXPECT_EQ(found.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(found.normals[1], glm::vec3(0, 1, 0));
    // A node that flattens leaves no normals, and no NaN.
    for (const auto& n : mesh(square_gltf({{"scale", {1, 0, 0}}})).normals)
        EXPECT_EQ(length(glm::dvec3(n)), 1);
}

// ---- Numbers

/// Shorts for positions and texture coordinates, bytes 4 apart for normals and tangents.
GltfBuilder quantised_square() {
    GltfBuilder gltf = square_gltf({{"scale", {1 / 32767.0, 1 / 32767.0, 1 / 32767.0}}});
    const std::int16_t one = 32767;
    const int positions = gltf.add<std::int16_t>(
        {0, 0, 0, 0, one, 0, 0, 0, one, one, 0, 0, 0, one, 0, 0}, 5122, "VEC3", 4);
    const int normals = gltf.add<std::int8_t>(
        {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, 5120, "VEC3", 4);
    const int tangents = gltf.add<std::int8_t>(
        {127, 0, 0, 127, 127, 0, 0, 127, 127, 0, 0, 127, 127, 0, 0, 127}, 5120, "VEC4", 4);
    for (const auto& [accessor, stride] : {std::pair{positions, 8}, {normals, 4}})
        gltf.json["bufferViews"][gltf.json["accessors"][accessor]["bufferView"].get<int>()]
                 ["byteStride"] = stride;
    for (const int accessor : {normals, tangents})
        gltf.json["accessors"][accessor]["normalized"] = true;
    auto& attributes = primitive_of(gltf)["attributes"];
    attributes["POSITION"] = positions;
    attributes["NORMAL"] = normals;
    attributes["TANGENT"] = tangents;
    gltf.json["extensionsUsed"] = gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    return gltf;
}

TEST_F(GltfGeometry, QuantisedAttributes) {
    const Mesh plain = mesh(square_gltf());
    const MeshFile found = read(quantised_square());
    EXPECT_TRUE(near(found.mesh.positions, plain.positions));
    EXPECT_EQ(found.mesh.normals, plain.normals);
    EXPECT_EQ(found.mesh.tangents, plain.tangents);
    EXPECT_TRUE(found.ignored.empty()) << "it is applied";
    GltfBuilder gltf = quantised_square();
    gltf.json["accessors"][5]["normalized"] = true;  // GltfDefect::not_normalised, the other way
    EXPECT_FALSE(near(mesh(gltf).positions, plain.positions));
}

TEST_F(GltfGeometry, WholeNumbersHoweverWritten) {
    GltfBuilder gltf = square_gltf();
    gltf.json["accessors"][0]["count"] = 4.0;
    gltf.json["accessors"][1]["byteOffset"] = 0.0;
    gltf.json["scene"] = 0.0;
    EXPECT_EQ(mesh(gltf).triangles.size(), 2u);
    gltf.json["accessors"][0]["count"] = 4.5;
    EXPECT_TRUE(complains([&] { mesh(gltf); }, {"accessors[0].count", "4.5", "an integer from 1"}));
}

TEST_F(GltfGeometry, SparseIndices) {
    GltfBuilder gltf = square_gltf();
    const int at = gltf.shorts({1, 2, 4, 5});
    const int values = gltf.shorts({1, 2, 2, 3});
    json& indices = gltf.json["accessors"][4];
    indices.erase("bufferView");  // all 0 but these
    indices["sparse"] = {
        {"count", 4},
        {"indices",
         {{"bufferView", gltf.json["accessors"][at]["bufferView"]}, {"componentType", 5123}}},
        {"values", {{"bufferView", gltf.json["accessors"][values]["bufferView"]}}}};
    EXPECT_EQ(mesh(gltf).triangles, mesh(square_gltf()).triangles);
}

// ---- Scenes

TEST_F(GltfGeometry, TheSceneThatTheFileNames) {
    GltfBuilder gltf = square_gltf();
    gltf.json["nodes"].push_back({{"mesh", 0}, {"translation", {7, 0, 0}}});
    gltf.json["scenes"].push_back({{"nodes", {1}}});
    EXPECT_EQ(mesh(gltf).positions[0].x, 0);
    EXPECT_EQ(read(gltf).ignored, std::vector<std::string>{"other scenes"});
    gltf.json["scene"] = 1;
    EXPECT_EQ(mesh(gltf).positions[0].x, 7);
    gltf.json.erase("scene");
    EXPECT_EQ(mesh(gltf).positions[0].x, 0) << "the first";
    gltf.json.erase("scenes");
    EXPECT_EQ(mesh(gltf).triangles.size(), 4u) << "all nodes";
}

TEST_F(GltfGeometry, HiddenNodes) {
    const json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
    GltfBuilder gltf = square_gltf();
    gltf.json["nodes"] = {{{"children", {1, 2}}},
                          {{"mesh", 0}},
                          {{"children", {3}}, {"extensions", hidden}},
                          {{"mesh", 0}}};
    EXPECT_EQ(mesh(gltf).triangles.size(), 2u);
    gltf.json["nodes"][2].erase("extensions");
    EXPECT_EQ(mesh(gltf).triangles.size(), 4u) << "GltfDefect::hidden_nodes_drawn";
}

TEST_F(GltfGeometry, WhatIsIgnoredIsNamed) {
    GltfBuilder gltf = square_gltf();
    gltf.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_texture_transform"};
    gltf.json["animations"] = json::array({json::object()});
    primitive_of(gltf)["attributes"]["COLOR_0"] = primitive_of(gltf)["attributes"]["TANGENT"];
    json points = primitive_of(gltf);
    points["mode"] = 0;
    gltf.json["meshes"][0]["primitives"].push_back(points);
    EXPECT_EQ(read(gltf).ignored, (std::vector<std::string>{"KHR_materials_clearcoat", "animations",
                                                            "COLOR_0", "points and lines"}));
}

}  // namespace
}  // namespace quadrel
