// Texture coordinates of glTF files: transforms, sets, and the tangents that belong to them.
#include <gtest/gtest.h>

#include "io/gltf/gltf_geometry.hpp"
#include "scene/planted.hpp"

namespace quadrel {
namespace {

using nlohmann::json;

class GltfUvs : public GltfGeometry {};

using Uvs = std::vector<glm::vec2>;

GltfBuilder with_transform(const json& transform, const char* texture = "normalTexture") {
    GltfBuilder gltf = square_gltf();
    primitive_of(gltf)["material"] = 0;
    gltf.json["materials"] = json::array(
        {{{texture, {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}});
    return gltf;
}

TEST_F(GltfUvs, TextureTransforms) {
    // The extension's example: the lower left quadrant of the picture.
    const json quadrant = {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
    const Uvs expected = {{.5f, 1}, {.5f, .5f}, {0, .5f}, {.125f, 1}};
    const auto uvs = [&](const json& transform) { return mesh(with_transform(transform)).uvs; };
    EXPECT_TRUE(near(uvs(quadrant), expected));
    json mirrored = quadrant;
    mirrored["rotation"] = -1.57079632679;
    EXPECT_FALSE(near(uvs(mirrored), expected)) << "GltfDefect::rotation_as_listed";
    EXPECT_FALSE(near(uvs(json::object()), expected)) << "GltfDefect::transform_ignored";
    // The second example: v from the bottom.
    EXPECT_EQ(uvs({{"offset", {0, 1}}, {"scale", {1, -1}}})[0], glm::vec2(0, 0));
}

TEST_F(GltfUvs, TangentsBelongToTheirCoordinates) {
    const auto tangent = [&](const json& transform) {
        const Mesh found = mesh(with_transform(transform));
        return found.tangents.empty() ? glm::vec4(0.0f) : found.tangents[0];
    };
    EXPECT_EQ(tangent({{"scale", {2, 3}}}), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(tangent({{"scale", {-2, 3}}}), glm::vec4(0.0f)) << "made anew where they are needed";
    EXPECT_EQ(tangent({{"rotation", 1}}), glm::vec4(0.0f));
}

TEST_F(GltfUvs, TheTransformOfTheFirstTextureThatReadsTheSet) {
    const auto texture = [](int set, double scale) {
        return json{{"index", 0},
                    {"texCoord", set},
                    {"extensions", {{"KHR_texture_transform", {{"scale", {scale, scale}}}}}}};
    };
    GltfBuilder gltf = with_transform({});
    gltf.json["materials"][0] = {{"pbrMetallicRoughness", {{"baseColorTexture", texture(1, 3)}}},
                                 {"normalTexture", texture(0, 2)},
                                 {"emissiveTexture", texture(0, 5)}};
    EXPECT_EQ(mesh(gltf).uvs[1], glm::vec2(2, 2));
    EXPECT_EQ(read(gltf).ignored, (std::vector<std::string>{"other texture transforms"}));
    // The extension's own texCoord counts for more.
    gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
             ["KHR_texture_transform"]["texCoord"] = 0;
    EXPECT_EQ(mesh(gltf).uvs[1], glm::vec2(3, 3));
    // Textures of extensions come last.
    gltf.json["materials"][0] = {
        {"extensions",
         {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseTexture", texture(0, 4)}}}}}};
    EXPECT_EQ(mesh(gltf).uvs[1], glm::vec2(4, 4));
}

TEST_F(GltfUvs, SetsOfTextureCoordinates) {
    GltfBuilder gltf = square_gltf();
    primitive_of(gltf)["attributes"]["TEXCOORD_1"] =
        gltf.floats({5, 0, 6, 0, 6, 1, 5, 1}, "VEC2", 2);
    MeshFileOptions second;
    second.uv_set = 1;
    EXPECT_EQ(read(gltf, second).mesh.uvs[0], glm::vec2(5, 0));
    EXPECT_NE(read(gltf).mesh.uvs[0], glm::vec2(5, 0)) << "GltfDefect::first_uv_set";
    EXPECT_EQ(read(gltf).uv_sets, 2);
    EXPECT_EQ(read(gltf).ignored, std::vector<std::string>{"TEXCOORD_1"});
    EXPECT_EQ(read(gltf, second).ignored, std::vector<std::string>{"TEXCOORD_0"});
    EXPECT_TRUE(read(gltf, second).mesh.tangents.empty()) << "they are those of the other set";
    second.uv_set = 2;
    EXPECT_TRUE(complains([&] { read(gltf, second); }, {"", "no TEXCOORD_2", "below 2"}));
}

}  // namespace
}  // namespace quadrel
