#include "gl/scene/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

#include "export/table.hpp"
#include "file/read_file.hpp"
#include "io/document/value.hpp"

namespace quadrel::gl {
namespace {

constexpr Word<Wrap> wraps[] = {{"repeat", Wrap::repeat},
                                {"mirrored-repeat", Wrap::mirrored_repeat},
                                {"clamp-to-edge", Wrap::clamp_to_edge},
                                {"clamp-to-border", Wrap::clamp_to_border},
                                {"mirror-once", Wrap::mirror_once}};
constexpr Word<Filter> filters[] = {{"nearest", Filter::nearest}, {"linear", Filter::linear}};
constexpr Word<MipFilter> mip_filters[] = {
    {"none", MipFilter::none}, {"nearest", MipFilter::nearest}, {"linear", MipFilter::linear}};
constexpr Word<int> uniform_types[] = {{"float", 1}, {"vec2", 2}, {"vec3", 3}, {"vec4", 4}};
constexpr Word<GLenum> texture_kinds[] = {
    {"2d", GL_TEXTURE_2D}, {"cube", GL_TEXTURE_CUBE_MAP}, {"2d-array", GL_TEXTURE_2D_ARRAY}};
constexpr Word<bool> channel_types[] = {{"float", false}, {"uint", true}};
constexpr Word<GLenum> internal_formats[] = {
    {"R8", GL_R8},       {"RG8", GL_RG8},     {"RGBA8", GL_RGBA8},
    {"SRGB8", GL_SRGB8}, {"RGB8", GL_RGB8},   {"SRGB8_ALPHA8", GL_SRGB8_ALPHA8},
    {"R16", GL_R16},     {"RG16", GL_RG16},   {"RGBA16", GL_RGBA16},
    {"R16F", GL_R16F},   {"RG16F", GL_RG16F}, {"RGBA16F", GL_RGBA16F},
    {"R32F", GL_R32F},   {"RG32F", GL_RG32F}, {"RGBA32F", GL_RGBA32F}};
constexpr Word<GLenum> formats[] = {
    {"RED", GL_RED}, {"RG", GL_RG}, {"RGB", GL_RGB}, {"RGBA", GL_RGBA}};
constexpr Word<GLenum> types[] = {{"UNSIGNED_BYTE", GL_UNSIGNED_BYTE},
                                  {"UNSIGNED_SHORT", GL_UNSIGNED_SHORT},
                                  {"HALF_FLOAT", GL_HALF_FLOAT},
                                  {"FLOAT", GL_FLOAT}};
constexpr Word<bool> clip_origins[] = {{"lower-left", false}, {"upper-left", true}};
constexpr Word<bool> clip_depths[] = {{"negative-one-to-one", false}, {"zero-to-one", true}};
constexpr Word<bool> first_rows[] = {{"bottom", false}, {"top", true}};
constexpr Word<GLenum> depth_tests[] = {{"less", GL_LESS}, {"greater", GL_GREATER}};
constexpr Word<GLenum> front_faces[] = {{"ccw", GL_CCW}, {"cw", GL_CW}};
constexpr Word<std::optional<GLenum>> culls[] = {
    {"none", std::nullopt}, {"back", GL_BACK}, {"front", GL_FRONT}};
constexpr int largest_side = 65536, most_elements = 1 << 28;
/// What OpenGL 3.3 has at least: samplers of a fragment shader, attributes, components of uniforms.
constexpr int most_samplers = 16, most_attributes = 16, most_in_array = 1024;

/// Calls `take` with each element of an array.
template <class Take>
void each(const SceneValue& array, const Take& take) {
    if (!array.json().is_array()) array.reject("an array");
    for (std::size_t i = 0; i < array.json().size(); ++i) take(array.element(i));
}

template <class T, class Read>
std::vector<T> read_all(const SceneValue& array, const Read& read) {
    std::vector<T> all;
    each(array, [&](const SceneValue& one) { all.push_back(read(one)); });
    return all;
}

/// A file of the folder, by a relative name that stays within it.
std::filesystem::path file_of(const std::filesystem::path& folder, const SceneValue& name) {
    const std::filesystem::path file = name.string();
    const auto normal = file.lexically_normal();
    if (file.empty() || file.is_absolute() || *normal.begin() == "..")
        name.reject("a file of the folder");
    return folder / file;
}

std::string bytes_of(const std::filesystem::path& folder, const SceneValue& name,
                     std::size_t expected) {
    const std::filesystem::path file = file_of(folder, name);
    std::string bytes = read_whole_file(file);
    if (bytes.size() != expected)
        throw InputError(file.string(), "", fmt::format("{} bytes", bytes.size()),
                         fmt::format("{}, as the manifest has it", expected));
    return bytes;
}

/// A number by a text: as a hex float it has all of its bits, and infinities and NaN are words.
float number_of(const SceneValue& hex) {
    const std::string text = hex.string();
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    if (text.empty() || *end != '\0') hex.reject("a number, as a hex float");
    return value;
}

/// A number of JSON, or as a text what JSON has no number for.
float real_of(const SceneValue& value) {
    return value.json().is_string() ? number_of(value) : static_cast<float>(value.number());
}

SceneValue at_most(const SceneValue& array, std::size_t most, const char* what) {
    if (array.json().is_array() && array.json().size() > most)
        array.fail(fmt::format("{} {}", array.json().size(), what),
                   fmt::format("{} at most", most));
    return array;
}

SceneValue four_of(const SceneValue& array, const char* what) {
    if (!array.json().is_array() || array.json().size() != 4)
        array.reject(fmt::format("four {}", what));
    return array;
}

Uniform read_uniform(const SceneValue& value) {
    Fields fields(value);
    Uniform uniform;
    uniform.name = fields.get("name").string();
    uniform.components = fields.get("type").word(uniform_types);
    const int count = fields.get("count").integer(0, most_in_array);
    uniform.values = read_all<float>(fields.get("hex"), number_of);
    const auto expected = static_cast<std::size_t>(std::max(count, 1) * uniform.components);
    if (uniform.values.size() != expected)
        fields.get("hex").fail(fmt::format("{} numbers", uniform.values.size()),
                               fmt::format("{}", expected));
    return uniform;
}

std::vector<Uniform> read_uniforms(const SceneValue& value) {
    return read_all<Uniform>(value, read_uniform);
}

int channels_of(GLenum format) {
    return format == GL_RED ? 1 : format == GL_RG ? 2 : format == GL_RGB ? 3 : 4;
}

int bytes_of(GLenum type) { return type == GL_UNSIGNED_BYTE ? 1 : type == GL_FLOAT ? 4 : 2; }

/// Of mip levels each has half the size of the one before, rounded down; or look-ups give nothing.
void check_levels(const ExportedTexture& texture, const SceneValue& named) {
    const std::vector<TextureLevel>& levels = texture.levels;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const int width = std::max(levels[i - 1].width / 2, 1),
                  height = std::max(levels[i - 1].height / 2, 1);
        if (levels[i].width != width || levels[i].height != height)
            named.fail(fmt::format("{}, whose level {} has {}x{} texels", texture.name, i,
                                   levels[i].width, levels[i].height),
                       fmt::format("{}x{}, half of the level before", width, height));
    }
}

/// An index into a list of so many.
std::size_t index_of(const SceneValue& value, std::size_t count, const char* of) {
    if (count == 0) value.reject(fmt::format("nothing, since the manifest has no {}", of));
    return static_cast<std::size_t>(value.integer(0, static_cast<int>(count) - 1));
}

ExportedTexture read_texture(const std::filesystem::path& folder, const SceneValue& value) {
    Fields fields(value);
    ExportedTexture texture;
    texture.name = fields.get("name").string();
    texture.target = fields.get("kind").word(texture_kinds);
    if (texture.target == GL_TEXTURE_CUBE_MAP) texture.layers = 6;
    if (texture.target == GL_TEXTURE_2D_ARRAY)
        texture.layers = fields.get("layers").integer(1, largest_side);
    Fields gl(fields.get("gl"));
    texture.internal_format = gl.get("internal_format").word(internal_formats);
    texture.format = gl.get("format").word(formats);
    texture.type = gl.get("type").word(types);
    each(fields.get("levels"), [&](const SceneValue& one) {
        Fields level(one);
        TextureLevel& read = texture.levels.emplace_back();
        read.width = level.get("width").integer(1, largest_side);
        read.height = level.get("height").integer(1, largest_side);
        const std::size_t texels = static_cast<std::size_t>(read.width) *
                                   static_cast<std::size_t>(read.height) *
                                   static_cast<std::size_t>(texture.layers);
        read.bytes = bytes_of(folder, level.get("bytes"),
                              texels * static_cast<std::size_t>(channels_of(texture.format) *
                                                                bytes_of(texture.type)));
    });
    if (texture.levels.empty()) fields.get("levels").reject("one level at least");
    const TextureLevel& first = texture.levels.front();
    if (texture.target == GL_TEXTURE_CUBE_MAP && first.width != first.height)
        fields.get("levels").element(0).fail(fmt::format("{}x{}", first.width, first.height),
                                             "faces of a cube, as wide as high");
    return texture;
}

ExportedSampler read_sampler(const SceneValue& value,
                             const std::vector<ExportedTexture>& textures) {
    Fields fields(value);
    ExportedSampler sampler;
    sampler.uniform = fields.get("uniform").string();
    sampler.texture = index_of(fields.get("texture"), textures.size(), "textures");
    const SceneValue wrap = fields.get("wrap");
    if (!wrap.json().is_array() || wrap.json().size() != 2) wrap.reject("two wrap modes");
    SamplerState& state = sampler.state;
    state.wrap_u = wrap.element(0).word(wraps);
    state.wrap_v = wrap.element(1).word(wraps);
    fields.read("mag", state.mag, filters);
    fields.read("min", state.min, filters);
    fields.read("mip", state.mip, mip_filters);
    if (state.mip != MipFilter::none)
        check_levels(textures[sampler.texture], fields.get("texture"));
    const SceneValue border = four_of(fields.get("border"), "numbers");
    for (std::size_t i = 0; i < 4; ++i) state.border[i] = real_of(border.element(i));
    state.lod_bias = real_of(fields.get("lod_bias"));
    state.lod_min = real_of(fields.get("lod_min"));
    state.lod_max = real_of(fields.get("lod_max"));
    return sampler;
}

ExportedMaterial read_material(const std::filesystem::path& folder, const SceneValue& value,
                               const std::vector<ExportedTexture>& textures) {
    Fields fields(value);
    ExportedMaterial material;
    material.name = fields.get("name").string();
    const std::filesystem::path fragment = file_of(folder, fields.get("fragment"));
    material.vertex = read_whole_file(file_of(folder, fields.get("vertex")));
    material.fragment = read_whole_file(fragment);
    material.fragment_file = fragment.string();
    material.cull = fields.get("cull").word(culls);
    material.samplers = read_all<ExportedSampler>(
        at_most(fields.get("samplers"), most_samplers, "samplers"),
        [&](const SceneValue& one) { return read_sampler(one, textures); });
    material.uniforms = read_uniforms(fields.get("uniforms"));
    return material;
}

Draw read_draw(const SceneValue& value, std::size_t materials, std::size_t indices) {
    Fields fields(value);
    Draw draw;
    draw.object = fields.get("object").string();
    draw.material = index_of(fields.get("material"), materials, "materials");
    draw.first_index =
        static_cast<std::size_t>(fields.get("first_index").integer(0, static_cast<int>(indices)));
    const SceneValue count = fields.get("index_count");
    draw.index_count =
        static_cast<std::size_t>(count.integer(0, static_cast<int>(indices - draw.first_index)));
    if (draw.index_count % 3 != 0) count.reject("whole triangles, a multiple of 3");
    draw.uniforms = read_uniforms(fields.get("uniforms"));
    return draw;
}

TargetChannel read_channel(const SceneValue& value) {
    if (value.json().is_null()) return {};
    Fields fields(value);
    return {fields.get("name").string(), fields.get("type").word(channel_types)};
}

Target read_target(const SceneValue& value) {
    Fields fields(value);
    Target target;
    const SceneValue clear = four_of(fields.get("clear"), "numbers");
    const SceneValue channels = four_of(fields.get("channels"), "channels");
    for (std::size_t i = 0; i < 4; ++i) {
        target.clear[i] = real_of(clear.element(i));
        target.channels[i] = read_channel(channels.element(i));
    }
    return target;
}

Pass read_pass(const SceneValue& value) {
    const SceneValue targets = Fields(value).get("targets");
    const Pass pass = read_all<Target>(at_most(targets, most_targets, "targets"), read_target);
    if (pass.empty()) targets.reject("one target at least");
    return pass;
}

void read_state(ExportedScene& scene, const SceneValue& value) {
    Fields fields(value);
    scene.upper_left = fields.get("clip_origin").word(clip_origins);
    scene.zero_to_one = fields.get("clip_depth").word(clip_depths);
    scene.first_row_is_top = fields.get("first_row").word(first_rows);
    const std::vector<double> range = fields.get("depth_range").numbers(2, 2, unit_interval);
    scene.depth_range = {range[0], range[1]};
    scene.depth_function = fields.get("depth_test").word(depth_tests);
    scene.depth_clear = fields.get("depth_clear").number(unit_interval);
    scene.front_face = fields.get("front_face").word(front_faces);
}

void read_vertices(ExportedScene& scene, const SceneValue& value) {
    Fields fields(value);
    // OpenGL 4.4 has strides of 2048 bytes at least.
    const int stride = fields.get("stride").integer(4, 2048);
    if (stride % 4 != 0) fields.get("stride").reject("a multiple of 4, the size of a float");
    scene.stride = static_cast<std::size_t>(stride);
    const auto count = static_cast<std::size_t>(fields.get("count").integer(0, most_elements));
    scene.vertices = bytes_of(scene.folder, fields.get("file"), count * scene.stride);
    each(fields.get("attributes"), [&](const SceneValue& one) {
        Fields attribute(one);
        VertexAttribute& read = scene.attributes.emplace_back();
        read.name = attribute.get("name").string();
        read.location = attribute.get("location").integer(0, most_attributes - 1);
        read.components = attribute.get("components").integer(1, std::min(stride / 4, 4));
        read.offset = static_cast<std::size_t>(
            attribute.get("offset").integer(0, stride - 4 * read.components));
    });
}

/// Indices are of vertices that there are: what lies behind the buffer is nobody's.
std::size_t read_indices(ExportedScene& scene, const SceneValue& value) {
    Fields fields(value);
    const auto count = static_cast<std::size_t>(fields.get("count").integer(0, most_elements));
    scene.indices = bytes_of(scene.folder, fields.get("file"), 4 * count);
    const std::size_t vertices = scene.vertices.size() / scene.stride;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t index = 0;
        std::memcpy(&index, scene.indices.data() + 4 * i, sizeof index);
        if (index >= vertices)
            throw InputError(file_of(scene.folder, fields.get("file")).string(), "",
                             fmt::format("index {} of vertex {}", i, index),
                             fmt::format("one of the {} vertices", vertices));
    }
    return count;
}

void read_origin(ExportedScene& scene, const SceneValue& value) {
    Fields fields(value);
    scene.scene_file = fields.get("file").string();
    scene.scene_hash = fields.get("hash").string();
    scene.overrides = read_all<std::string>(fields.get("overrides"),
                                            [](const SceneValue& one) { return one.string(); });
}

void read_contents(ExportedScene& scene, Fields& fields) {
    read_vertices(scene, fields.get("vertex_buffer"));
    const std::size_t indices = read_indices(scene, fields.get("index_buffer"));
    scene.textures = read_all<ExportedTexture>(fields.get("textures"), [&](const SceneValue& one) {
        return read_texture(scene.folder, one);
    });
    scene.materials = read_all<ExportedMaterial>(
        fields.get("materials"),
        [&](const SceneValue& one) { return read_material(scene.folder, one, scene.textures); });
    scene.uniforms = read_uniforms(fields.get("uniforms"));
    scene.draws = read_all<Draw>(fields.get("draws"), [&](const SceneValue& one) {
        return read_draw(one, scene.materials.size(), indices);
    });
    scene.passes = read_all<Pass>(fields.get("passes"), read_pass);
    if (scene.passes.empty()) fields.get("passes").reject("one pass at least");
    for (const ExportedMaterial& material : scene.materials)
        if (scene.passes.size() > 1 &&
            material.fragment.find("#define PASS 0\n") == std::string::npos)
            throw InputError(material.fragment_file, "", "no \"#define PASS 0\"",
                             "one, for the passes of the manifest");
}

}  // namespace

ExportedScene read_exported_scene(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "manifest.json";
    const SceneDocument document = parse_scene_text(read_whole_file(file), file);
    const SceneValue root(document, document.root, "");
    Fields fields(root);
    fields.get("quadrel-export").integer(1, 1);
    ExportedScene scene;
    scene.folder = folder;
    read_origin(scene, fields.get("scene"));
    scene.language = fields.get("language").string();
    if (!scene.language.starts_with("glsl"))
        fields.get("language").reject("glsl or glsl-es, which OpenGL takes");
    scene.hardware = fields.get("hardware").string();
    const std::vector<double> size = fields.get("size").numbers(2, 2, {1, largest_side});
    scene.width = static_cast<int>(size[0]);
    scene.height = static_cast<int>(size[1]);
    scene.samples = fields.get("samples").integer(1, 16);
    if (!std::has_single_bit(static_cast<unsigned>(scene.samples)))
        fields.get("samples").reject("1, 2, 4, 8 or 16");
    read_state(scene, fields.get("state"));
    read_contents(scene, fields);
    return scene;
}

}  // namespace quadrel::gl
