// Textures of arrays and files, and maps derived from them.
#include <pybind11/stl.h>

#include "bake/layers/closed_mesh.hpp"
#include "bake/layout.hpp"
#include "bake/wrap_names.hpp"
#include "file/atomic_file.hpp"
#include "io/scene/setting_words.hpp"
#include "python/bindings.hpp"
#include "python/interruptible.hpp"
#include "quadrel/bake/baked_file.hpp"
#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/bake/depth_layers.hpp"
#include "quadrel/scene/hardware_sampler.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::python {
namespace {

using FloatArray = py::array_t<float, py::array::c_style | py::array::forcecast>;

constexpr std::pair<std::string_view, MipRule> mip_rule_words[] = {
    {"none", MipRule::none}, {"box", MipRule::box}, {"area", MipRule::area}};
constexpr std::pair<std::string_view, Filter> filter_words[] = {{"nearest", Filter::nearest},
                                                                {"linear", Filter::linear}};
constexpr std::pair<std::string_view, MipFilter> mip_filter_words[] = {
    {"none", MipFilter::none}, {"nearest", MipFilter::nearest}, {"linear", MipFilter::linear}};

TextureOptions texture_options(const std::string& swizzle, bool srgb, const std::string& format,
                               const std::string& mips, bool flip_v) {
    TextureOptions options;
    options.swizzle = swizzle;
    options.srgb = srgb;
    if (!format.empty()) options.format = value_of("format", format, named_formats);
    options.mip_rule = value_of("mips", mips, mip_rule_words);
    options.flip_v = flip_v;
    return options;
}

/// Of rows of texels, each of 1 to 4 channels. `stored` is the format that the values are of.
HeldTexture texture_of_array(const FloatArray& texels, const std::string& stored,
                             const TextureOptions& options) {
    if (texels.ndim() != 3 || texels.shape(0) < 1 || texels.shape(1) < 1 || texels.shape(2) < 1 ||
        texels.shape(2) > 4 || texels.shape(0) > max_image_side || texels.shape(1) > max_image_side)
        throw UsageError(
            "texture: expected an array of (height, width) or (height, width, 1 to 4), of 1 to "
            "65536 texels a side");
    Image image;
    image.width = static_cast<int>(texels.shape(1));
    image.height = static_cast<int>(texels.shape(0));
    image.channels = static_cast<int>(texels.shape(2));
    image.format = value_of("format", stored, named_formats);
    image.values.assign(texels.data(), texels.data() + texels.size());
    const Unlocked unlocked;
    return {make_texture(image, options), {}};
}

/// Of levels that someone else has made, the finest first, taken as they are.
HeldTexture texture_of_levels(const std::vector<FloatArray>& levels) {
    const char* const expected =
        "levels: expected arrays of (height, width, 1, 2 or 4), each level half the one before, "
        "rounded down, but no less than 1";
    std::vector<LevelSize> sizes;
    for (const FloatArray& level : levels) {
        const bool fits = level.ndim() == 3 && level.shape(0) >= 1 && level.shape(1) >= 1 &&
                          level.shape(0) <= max_image_side && level.shape(1) <= max_image_side &&
                          level.shape(2) == levels[0].shape(2);
        if (!fits) throw UsageError(expected);
        const LevelSize size(static_cast<int>(level.shape(1)), static_cast<int>(level.shape(0)));
        if (!sizes.empty() && size != LevelSize(std::max(sizes.back().first / 2, 1),
                                                std::max(sizes.back().second / 2, 1)))
            throw UsageError(expected);
        sizes.push_back(size);
    }
    const int channels = levels.empty() ? 0 : static_cast<int>(levels[0].shape(2));
    if (channels != 1 && channels != 2 && channels != 4) throw UsageError(expected);
    const auto layout = make_layout(channels, 1, sizes);
    if (!layout) throw UsageError("levels: expected at most 17 levels and 2^29 floats");
    const auto texture = std::make_shared<Texture>(*layout, TexelFormat::float32, "levels");
    for (std::size_t l = 0; l < levels.size(); ++l)
        std::memcpy(texture->level_texels(static_cast<int>(l), 0), levels[l].data(),
                    static_cast<std::size_t>(levels[l].nbytes()));
    return {texture, {}};
}

HeldTexture read_texture(const std::string& file, const TextureOptions& options,
                         const std::string& layer, const std::string& part) {
    const Unlocked unlocked;
    Image image;
    HeldTexture held;
    held.inputs = inputs_of([&] {
        image = load_image(file, NotFinite::refuse, "", {layer, part});
    });
    held.texture = make_texture(image, options);
    return held;
}

/// A view that cannot be written to: (height, width, channels), of several layers (layers, height,
/// width, channels). It keeps the texture.
py::array level_array(const py::object& self, int level) {
    const Texture& texture = *self.cast<const HeldTexture&>().texture;
    const TextureView& view = texture.view();
    if (level < 0 || level >= view.levels) throw py::index_error("no such level");
    const py::ssize_t size = sizeof(float), channels = view.channels, width = view.width[level],
                      height = view.height[level];
    std::vector<py::ssize_t> shape{height, width, channels};
    std::vector<py::ssize_t> strides{width * channels * size, channels * size, size};
    if (view.faces > 1) {
        shape.insert(shape.begin(), view.faces);
        strides.insert(strides.begin(), height * width * channels * size);
    }
    py::array array(py::dtype::of<float>(), shape, strides, texture.level_texels(level, 0), self);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

SamplerState make_sampler(const std::string& wrap_u, const std::string& wrap_v,
                          const std::string& mag, const std::string& min, const std::string& mip,
                          const std::array<float, 4>& border, float bias, float least, float most,
                          const std::string& hardware) {
    SamplerState sampler;
    sampler.wrap_u = value_of("wrap_u", wrap_u, wrap_modes());
    sampler.wrap_v = value_of("wrap_v", wrap_v, wrap_modes());
    sampler.mag = value_of("mag", mag, filter_words);
    sampler.min = value_of("min", min, filter_words);
    sampler.mip = value_of("mip", mip, mip_filter_words);
    std::copy(border.begin(), border.end(), sampler.border);
    sampler.lod_bias = bias;
    sampler.lod_min = least;
    sampler.lod_max = most;
    return on_hardware(sampler, hardware_model(value_of("hardware", hardware, hardware_words)));
}

HeldTexture bake_map(const HeldTexture& heights, const std::string& kind_name,
                     const SamplerState& sampler, const std::map<std::string, double>& parameters,
                     bool cache, int threads, const std::optional<std::string>& output,
                     const py::object& progress) {
    if (output) {
        check_output("output", *output, heights.inputs);
        check_writable(*output);
    }
    const BakeKind kind = bake_kind_from_name(kind_name);
    BakedTextureOptions options;
    options.parameters = parameters;
    options.disk = cache;
    options.threads = threads;
    options.seconds_limit = std::numeric_limits<double>::infinity();
    HeldTexture map;
    run_interruptibly(progress, [&](Work& work) {
        options.progress = [&](double share) { work.report(share); };
        map.texture = baked_texture(*heights.texture, kind, sampler, options);
        if (output) write_baked(*output, *map.texture, *heights.texture, kind, sampler, options);
    });
    return map;
}

/// A film of the layers, the length of a tile and the thickness of the relief in the mesh's own
/// units, and under how many texels more solids lie than are kept.
py::tuple peel_layers(const std::string& mesh, int width, int height,
                      const std::array<double, 3>& towards, double margin, int solids,
                      const py::object& progress) {
    const auto named = std::make_shared<NamedFilm>();
    DepthLayers layers;
    run_interruptibly(progress, [&](Work& work) {
        Mesh solid;
        named->inputs = inputs_of([&] { solid = closed_mesh(mesh); });
        DepthLayerOptions options{
            width, height, {towards[0], towards[1], towards[2]}, margin, solids};
        options.progress = [&](double share) { work.report(share); };
        layers = peel_depth_layers(solid, options);
    });
    named->attributes = attributes_of(layers);
    named->film = std::move(layers.film);
    return py::make_tuple(named, layers.tile, layers.thickness, layers.deeper);
}

}  // namespace

void bind_textures(py::module_& module) {
    py::class_<TextureOptions>(module, "TextureOptions")
        .def(py::init(&texture_options), py::arg("swizzle"), py::arg("srgb"), py::arg("format"),
             py::arg("mips"), py::arg("flip_v"));
    py::class_<SamplerState>(module, "SamplerState")
        .def(py::init(&make_sampler), py::arg("wrap_u"), py::arg("wrap_v"), py::arg("mag"),
             py::arg("min"), py::arg("mip"), py::arg("border"), py::arg("lod_bias"),
             py::arg("lod_min"), py::arg("lod_max"), py::arg("hardware"));
    const auto view = [](auto member) {
        return [member](const HeldTexture& held) { return held.texture->view().*member; };
    };
    py::class_<HeldTexture>(module, "Texture")
        .def_property_readonly("channels", view(&TextureView::channels))
        .def_property_readonly("layers", view(&TextureView::faces))
        .def_property_readonly("level_count", view(&TextureView::levels))
        .def_property_readonly("format",
                               [](const HeldTexture& held) {
                                   return std::string(format_name(held.texture->format()));
                               })
        .def("level", level_array, py::arg("level"));
    module.def("texture_of_array", texture_of_array, py::arg("texels"), py::arg("stored"),
               py::arg("options"));
    module.def("texture_of_levels", texture_of_levels, py::arg("levels"));
    module.def("read_texture", read_texture, py::arg("file"), py::arg("options"), py::arg("layer"),
               py::arg("part"));
    module.def(
        "bakes_layers",
        [](const std::string& kind) { return bakes_layers(bake_kind_from_name(kind)); },
        py::arg("kind"));
    module.attr("most_solids") = most_solids;
    module.def("peel_layers", peel_layers, py::arg("mesh"), py::arg("width"), py::arg("height"),
               py::arg("towards"), py::arg("margin"), py::arg("solids"), py::arg("progress"));
    module.def("bake", bake_map, py::arg("heights"), py::arg("kind"), py::arg("sampler"),
               py::arg("parameters"), py::arg("cache"), py::arg("threads"), py::arg("output"),
               py::arg("progress"));
}

}  // namespace quadrel::python
