// What an exported scene hands a GPU: vertices that become what Quadrel interpolates, and texels
// whose bytes are the very values.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <set>

#include "export/scene/content.hpp"
#include "export/scene/small_scenes.hpp"
#include "quadrel/bake/bake.hpp"
#include "quadrel/num/half.hpp"
#include "quadrel/num/srgb.hpp"
#include "render/draw/geometry.hpp"

namespace quadrel::export_tests {
namespace {

using Floats = std::vector<float>;

/// The vertex shader's arithmetic.
float affine(const Floats& m, int row, const Floats& p) {
    const std::size_t r = std::size_t(row) * 4;
    return (m[r] * p[0] + m[r + 1] * p[1]) + (m[r + 2] * p[2] + m[r + 3]);
}
float linear_row(const Floats& m, int row, const Floats& v) {
    const std::size_t r = std::size_t(row) * 3;
    return m[r] * v[0] + m[r + 1] * v[1] + m[r + 2] * v[2];
}

/// Attributes of the vertex that an index names, by their names.
std::map<std::string, Floats> vertex(const VertexBuffers& buffers, std::uint32_t index) {
    std::map<std::string, Floats> values;
    const float* const all =
        buffers.vertices.data() + std::size_t(index) * std::size_t(buffers.floats_a_vertex());
    for (const VertexAttribute& attribute : buffers.attributes) {
        const float* const first = all + attribute.offset / int(sizeof(float));
        values[attribute.name] = Floats(first, first + attribute.components);
    }
    return values;
}

/// P, normal, uv, face normal, tangent, handedness, bitangent, J, quadric of a corner.
Floats shaded(const VertexBuffers& buffers, std::uint32_t index, const UniformValues& object,
              const UniformValues& material) {
    const auto of = vertex(buffers, index);
    Floats all;
    for (int row = 0; row < 3; ++row)
        all.push_back(affine(object.at("model_view"), row, of.at("position")));
    const bool flat = object.at("flat_faces")[0] != 0;
    for (int row = 0; row < 3; ++row)
        all.push_back(flat ? of.at("face_normal")[std::size_t(row)]
                           : linear_row(object.at("normal_matrix"), row, of.at("normal")));
    const Floats uv{of.at("texture_coordinates")[0], of.at("texture_coordinates")[1], 0};
    for (int row = 0; row < 2; ++row) all.push_back(affine(material.at("texture_matrix"), row, uv));
    for (const char* name : {"face_normal", "tangent", "handedness", "bitangent", "gradient_u",
                             "gradient_v", "curvature"})
        all.insert(all.end(), of.at(name).begin(), of.at(name).end());
    return all;
}

/// Attributes that are not what transforming the mesh's own gives; position in clip space included.
int wrongly_shaded(const VertexBuffers& buffers, std::uint32_t index, const UniformValues& object,
                   const UniformValues& material, const UniformValues& frame) {
    const auto of = vertex(buffers, index);
    Floats expected, found;
    for (const char* name : {"eye_position", "eye_normal", "mapped_coordinates", "clip_position"})
        found.insert(found.end(), of.at(name).begin(), of.at(name).end());
    const Floats all = shaded(buffers, index, object, material);
    expected.assign(all.begin(), all.begin() + 8);
    for (int row = 0; row < 4; ++row)
        expected.push_back(affine(frame.at("projection"), row, of.at("eye_position")));
    return expected != found;
}

/// The same of Quadrel's own triangle.
Floats interpolated(const Geometry& geometry, std::size_t triangle, int corner) {
    const PrimitiveData& data = geometry.data[triangle];
    const PrimitiveFrame& frame = geometry.frames[triangle];
    Floats all;
    const auto add = [&](const float* from, int count) {
        all.insert(all.end(), from, from + count);
    };
    add(data.position[corner], 3);
    add(data.normal[corner], 3);
    add(data.uv[corner], 2);
    add(data.face_normal, 3);
    add(frame.tangent[corner], 3);
    add(&frame.tangent_sign[corner], 1);
    add(frame.bitangent[corner], 3);
    add(frame.J, 6);
    add(frame.quadric[corner], 2);
    return all;
}

VertexBuffers all_buffers(const Scene& scene) {
    return vertex_buffers(scene, SceneShells(scene), all_vertex_attributes(),
                          [](std::size_t, const VertexList&) { return NamedFloats(); });
}

/// How many corners of whole triangles are not what Quadrel has; -1 if there are none.
template <class Change>
int wrong_corners(const Scene& scene, const Change& change) {
    const Geometry geometry = assemble_geometry(scene, scene_hardware(scene), {true, false, true});
    const VertexBuffers buffers = all_buffers(scene);
    int wrong = 0, seen = 0;
    for (const Draw& draw : buffers.draws) {
        const Object& object = scene.objects[draw.object];
        UniformValues values = object_values_by_name(scene, object);
        change(values);
        const UniformValues material = material_values_by_name(scene.materials[object.material]);
        const UniformValues frame =
            frame_values_by_name(frame_uniforms(scene, scene_hardware(scene)));
        for (std::uint32_t i = 0; i < draw.index_count; ++i)
            wrong += wrongly_shaded(buffers, buffers.indices[draw.first_index + i], values,
                                    material, frame);
        // Drawn triangles keep their order; what is clipped or culled is missing among Quadrel's.
        std::set<Floats> corners;
        for (std::uint32_t i = 0; i < draw.index_count; ++i)
            corners.insert(
                shaded(buffers, buffers.indices[draw.first_index + i], values, material));
        for (std::size_t t = 0; t < geometry.triangles.size(); ++t) {
            if (geometry.triangles[t].object != draw.object) continue;
            for (int corner = 0; corner < 3; ++corner, ++seen)
                wrong += corners.count(interpolated(geometry, t, corner)) == 0;
        }
    }
    return seen > 0 ? wrong : -1;
}

TEST(SceneBuffers, VerticesBecomeWhatQuadrelInterpolates) {
    const SmallScenes scenes;
    for (const char* name : {"thesis-quad", "thesis-icosahedron", "rows/frame-mikkt",
                             "rows/frame-vertex", "sampler-texture-matrix"})
        EXPECT_EQ(wrong_corners(scenes.load(name), [](UniformValues&) {}), 0) << name;
    // A matrix by columns, and normals that go like points.
    const Scene scene = scenes.load("thesis-icosahedron");
    EXPECT_GT(wrong_corners(scene,
                            [](UniformValues& values) {
                                std::swap(values["model_view"][11], values["model_view"][14]);
                            }),
              0);
    EXPECT_GT(
        wrong_corners(scene, [](UniformValues& values) { values["normal_matrix"][1] += 0.5f; }), 0);
}

TEST(SceneBuffers, MirroredObjectsKeepTheirOutside) {
    const SmallScenes scenes;
    Scene scene = scenes.load("thesis-icosahedron");
    for (Material& material : scene.materials) material.cull = Cull::back;
    scene.objects = {scene.objects[1]};  // in view
    scene.objects[0].transform[0] *= -1.0f;
    const Geometry geometry = assemble_geometry(scene, scene_hardware(scene), {true, false, true});
    ASSERT_FALSE(geometry.triangles.empty());
    const VertexBuffers buffers = all_buffers(scene);
    const UniformValues object = object_values_by_name(scene, scene.objects[0]);
    const UniformValues material =
        material_values_by_name(scene.materials[scene.objects[0].material]);
    // In the order of drawing, corner by corner.
    std::set<std::vector<Floats>> triangles;
    for (std::size_t i = 0; i < buffers.indices.size(); i += 3)
        triangles.insert({shaded(buffers, buffers.indices[i], object, material),
                          shaded(buffers, buffers.indices[i + 1], object, material),
                          shaded(buffers, buffers.indices[i + 2], object, material)});
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t)
        EXPECT_EQ(triangles.count({interpolated(geometry, t, 0), interpolated(geometry, t, 1),
                                   interpolated(geometry, t, 2)}),
                  1u);
}

float decoded(const std::string& bytes, std::size_t i, TexelFormat format, bool is_alpha) {
    const auto read = [&](auto number) {
        std::memcpy(&number, bytes.data() + i * sizeof number, sizeof number);
        return number;
    };
    switch (format) {
        case TexelFormat::unorm8:
            return static_cast<float>(read(std::uint8_t())) / 255.0f;
        case TexelFormat::srgb8:
            return is_alpha ? static_cast<float>(read(std::uint8_t())) / 255.0f
                            : static_cast<float>(srgb_decode(read(std::uint8_t()) / 255.0));
        case TexelFormat::unorm16:
            return static_cast<float>(read(std::uint16_t())) / 65535.0f;
        case TexelFormat::half:
            return half_to_float(read(std::uint16_t()));
        case TexelFormat::float32:
            break;
    }
    return read(float());
}

/// Values of a level that its bytes do not give back, missing channels among them.
int wrong_texels(const Texture& texture, int level, const TexelLayout& layout,
                 const std::string& bytes) {
    const Image image = texture_level(texture, level);
    int wrong = 0;
    const auto channels = static_cast<std::size_t>(layout.channels);
    const std::size_t texels = std::size_t(image.width) * std::size_t(image.height);
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < channels; ++c) {
            const float expected = c < std::size_t(image.channels)
                                       ? image.values[i * std::size_t(image.channels) + c]
                                       : (c == 3 ? 1.0f : 0.0f);
            wrong += decoded(bytes, i * channels + c, layout.format, c == 3) != expected;
        }
    return wrong;
}

TEST(SceneBuffers, BytesOfTexelsDecodeToTheVeryValues) {
    for (const TexelFormat format : {TexelFormat::unorm8, TexelFormat::srgb8, TexelFormat::unorm16,
                                     TexelFormat::half, TexelFormat::float32})
        for (const char* swizzle : {"r", "rg", "rgba"})
            for (const char* language : {"glsl", "glsl-es"}) {
                TextureOptions options;
                options.swizzle = swizzle;
                options.format = format;
                const auto texture = make_texture(small_image(), options);
                const TexelLayout layout = texel_layout(*texture, language);
                for (int level = 0; level < texture->view().levels; ++level) {
                    std::string bytes = level_bytes(*texture, level, layout);
                    EXPECT_EQ(wrong_texels(*texture, level, layout, bytes), 0) << swizzle;
                    // The last byte of a number is its largest.
                    bytes.back() = static_cast<char>(bytes.back() ^ 0x21);
                    EXPECT_GT(wrong_texels(*texture, level, layout, bytes), 0) << swizzle;
                }
            }
}

/// Where a GPU would read 0 of a channel that there is not.
TEST(SceneBuffers, DepthLayersThatAMapLacksAreAtTheBottom) {
    for (const char* swizzle : {"r", "rg", "rgba"}) {
        TextureOptions options;
        options.swizzle = swizzle;
        options.format = TexelFormat::unorm16;
        const auto texture = make_texture(small_image(), options);
        const TexelLayout layout = depth_layers_layout(*texture, "glsl");
        EXPECT_EQ(layout.internal_format, "RGBA16");
        const std::string bytes = level_bytes(*texture, 0, layout);
        const auto has = static_cast<std::size_t>(texture->view().channels);
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_EQ(decoded(bytes, c, layout.format, c == 3),
                      c < has ? texture->level_texels(0, 0)[c] : 1);
    }
}

/// A pyramid of 17x17 cells: 17, 9, 5, 3, 2, 1.
TEST(SceneBuffers, PyramidsAreMipChainsOfAPowerOfTwo) {
    TextureOptions options;
    options.swizzle = "r";
    options.mip_rule = MipRule::none;
    SamplerState clamped;
    clamped.wrap_u = clamped.wrap_v = Wrap::clamp_to_edge;
    const auto pyramid = bake(*make_texture(small_image(), options), BakeKind::max_mip, clamped);
    const TextureView& view = pyramid->view();
    ASSERT_FALSE(has_mip_sizes(view));
    const TexelLayout layout = texel_layout(*pyramid, "glsl");
    for (int level = 0; level < view.levels; ++level) {
        const LevelSide side = side_of_level(view, level);
        EXPECT_EQ(side.width, 32 >> level);
        const std::string bytes = level_bytes(*pyramid, level, layout);
        ASSERT_EQ(bytes.size(), std::size_t(side.width) * std::size_t(side.height) * 4);
        const Image image = texture_level(*pyramid, level);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                EXPECT_EQ(decoded(bytes, std::size_t(y * side.width + x), layout.format, false),
                          image.values[std::size_t(y * image.width + x)]);
    }
}

/// Level 0 as an array of slices, texel by texel where direction_table.hpp has it; what it says of
/// itself as uniforms.
TEST(SceneBuffers, TablesByDirectionsAreArraysAndNumbers) {
    const SmallScenes scenes;
    const Scene scene = scenes.load("rows/vdm");
    SceneExport options;
    options.reference = false;
    const ExportContent content = export_content(scene, options);
    const auto found = std::ranges::find_if(content.textures, [](const ContentTexture& of) {
        return of.shape == TextureShape::layers;
    });
    ASSERT_NE(found, content.textures.end());
    const Texture& table = *found->texture;
    const TextureView& view = table.view();
    EXPECT_EQ(found->levels, 1);
    EXPECT_FALSE(found->is_padded());
    EXPECT_EQ(found->side(0).width, view.width[0]);
    EXPECT_EQ(found->rows(0), view.height[0]);
    const std::string bytes = found->bytes(0, found->layout);
    const std::size_t a_slice = std::size_t(view.width[0]) * std::size_t(view.height[0]);
    ASSERT_EQ(bytes.size(), a_slice * std::size_t(view.faces) * sizeof(float));
    for (int slice = 0; slice < view.faces; ++slice)
        EXPECT_EQ(std::memcmp(bytes.data() + std::size_t(slice) * a_slice * sizeof(float),
                              table.level_texels(0, slice), a_slice * sizeof(float)),
                  0)
            << slice;
    const UniformValues& numbers = content.materials.front().uniforms;
    EXPECT_EQ(numbers.at("vdm_map_depth"), Floats{table.level_texels(2, 0)[0]});
    EXPECT_EQ(numbers.at("vdm_map_curvature"), Floats{table.level_texels(2, 0)[1]});
    for (const char* name : {"vdm_map_depth", "vdm_map_curvature"})
        EXPECT_NE(
            content.materials.front().program.fragment.find(std::string("uniform float ") + name),
            std::string::npos);
}

TEST(SceneBuffers, FormatsHaveTheirNames) {
    TextureOptions options;
    options.swizzle = "r";
    options.format = TexelFormat::unorm16;
    const auto height = make_texture(small_image(), options);
    const TexelLayout layout = texel_layout(*height, "glsl");
    EXPECT_EQ(layout.internal_format + " " + layout.components + " " + layout.component_type,
              "R16 RED UNSIGNED_SHORT");
    EXPECT_EQ(layout.dxgi, "R16_UNORM");
    EXPECT_EQ(texel_layout(*height, "glsl-es").internal_format, "R32F");
    options.swizzle = "rgb1";
    options.format = TexelFormat::srgb8;
    const auto color = make_texture(small_image(), options);
    EXPECT_EQ(texel_layout(*color, "hlsl").dxgi, "R8G8B8A8_UNORM_SRGB");
    EXPECT_EQ(texel_layout(*color, "glsl").internal_format, "SRGB8_ALPHA8");
    options.swizzle = "rg";
    options.format = TexelFormat::half;
    EXPECT_EQ(texel_layout(*make_texture(small_image(), options), "glsl").internal_format, "RG16F");
}

}  // namespace
}  // namespace quadrel::export_tests
