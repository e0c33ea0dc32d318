#include "quadrel/bake/packed_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "bake/rounding.hpp"
#include "io/image/png_codes.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel {

namespace {

enum class Direction { down, up, nearest };

/// What a channel can store: 8-bit codes, or any float.
struct Store {
    bool codes;

    /// The stored value next to `guess` whose decoded value is the nearest to x in [0, 1] that is
    /// not above (not below) it; `decode` grows.
    template <class Decode>
    float operator()(double x, float guess, Direction direction, const Decode& decode) const {
        if (!codes)
            return direction == Direction::nearest ? guess : walk(guess, x, direction, decode);
        const float nearest = std::nearbyint(guess * 255.0f);
        if (direction == Direction::nearest) return nearest / 255.0f;
        return walk(nearest / 255.0f, x, direction, decode);
    }

  private:
    float step(float stored, bool up) const {
        if (!codes) return std::nextafter(stored, up ? 2.0f : -1.0f);
        return (std::nearbyint(stored * 255.0f) + (up ? 1.0f : -1.0f)) / 255.0f;
    }
    template <class Decode>
    float walk(float stored, double x, Direction direction, const Decode& decode) const {
        const bool up = direction == Direction::up;
        const auto safe = [&](float s) { return up ? decode(s) >= x : decode(s) <= x; };
        while (!safe(stored)) stored = step(stored, up);
        for (float next = step(stored, !up); next >= 0 && next <= 1 && safe(next);
             next = step(next, !up))
            stored = next;
        return stored;
    }
};

struct TexelPacker {
    Store store;
    PackRounding rounding;

    Direction direction(Direction conservative) const {
        return rounding == PackRounding::nearest ? Direction::nearest : conservative;
    }
    static double same(float stored) { return stored; }
    static double squared(float stored) { return static_cast<double>(stored) * stored; }

    void pack(const float* cone, const float* normal, Packing packing, float* out) const {
        const float h = std::clamp(cone[0], 0.0f, 1.0f), c = std::clamp(cone[1], 0.0f, 1.0f);
        if (packing == Packing::height_root) {
            out[0] = store(h, h, Direction::nearest, same);
            out[1] = store(c, c, Direction::nearest, same);
            out[2] = 0;
            return;
        }
        if (packing == Packing::height_sqrt_cone) {
            out[0] = store(h, h, direction(Direction::up), same);
            out[1] = store(c, std::sqrt(c), direction(Direction::down), squared);
            out[2] = 0;
            return;
        }
        out[0] = store(normal[0], normal[0], Direction::nearest, same);
        out[1] = store(1 - normal[1], 1 - normal[1], Direction::nearest, same);
        out[2] = store(c, c, direction(Direction::down), same);
        out[3] = store(1.0 - static_cast<double>(h), 1 - h, direction(Direction::down), same);
    }
};

void write_values(const std::filesystem::path& file, const Texture& map, int channels,
                  const std::vector<float>& values, const ExrWriting& writing) {
    const int width = map.view().width[0], height = map.view().height[0];
    if (file.extension() == ".png") {
        std::vector<std::uint8_t> codes;
        for (const float v : values)
            codes.push_back(static_cast<std::uint8_t>(std::nearbyint(v * 255.0f)));
        return write_png_codes(file, width, height, channels, codes);
    }
    Film film;
    film.frame = film.window = {0, 0, width, height};
    for (int c = 0; c < channels; ++c) {
        Plane& plane = film.add(std::string(1, "RGBA"[c]), ChannelType::float32);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            plane.bits[i] = std::bit_cast<std::uint32_t>(values[i * channels + c]);
    }
    write_exr(file, film, {{"quadrel:bake.id", map.id()}}, writing);
}

std::shared_ptr<const Texture> make_plain(int width, int height, int channels,
                                          std::vector<float> values,
                                          const std::filesystem::path& file) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.values = std::move(values);
    image.file = file;
    TextureOptions options;
    options.mip_rule = MipRule::none;
    return make_texture(image, options);
}

}  // namespace

Packing packing_from_name(std::string_view name, BakeKind kind) {
    const bool holds_root = kind == BakeKind::cone_rabbid;
    if (name == "dummer") return holds_root ? Packing::height_root : Packing::height_sqrt_cone;
    if (name == "gg3") return Packing::normal_cone_depth;
    throw UsageError(fmt::format("packing \"{}\" is unknown; expected dummer or gg3", name));
}

bool is_packable(BakeKind kind, Packing packing) {
    if (packing == Packing::height_root) return kind == BakeKind::cone_rabbid;
    switch (kind) {
        case BakeKind::cone:
        case BakeKind::cone_robust:
        case BakeKind::cone_quick:
        case BakeKind::relaxed_cone:
        case BakeKind::relaxed_cone_exact:
            return true;
        default:
            return false;
    }
}

void write_packed(const std::filesystem::path& file, const Texture& map, const Texture& height,
                  const SamplerState& sampler, Packing packing, PackRounding rounding,
                  const ExrWriting& writing) {
    const TextureView &cones = map.view(), &heights = height.view();
    if (cones.channels != 2 || cones.faces != 1 || cones.levels != 1 ||
        cones.width[0] != heights.width[0] || cones.height[0] != heights.height[0])
        throw UsageError("only maps of a height and a ratio a texel can be packed");
    if (file.extension() != ".png" && file.extension() != ".exr")
        throw UsageError(fmt::format("packed maps are .png or .exr, not \"{}\"", file.string()));
    const bool with_normals = packing == Packing::normal_cone_depth;
    const auto normals = with_normals ? bake(height, BakeKind::normal_4tap, sampler)
                                      : std::shared_ptr<const Texture>();
    const int channels = with_normals ? 4 : 3;
    const std::size_t count = static_cast<std::size_t>(cones.width[0]) * cones.height[0];
    std::vector<float> values(count * channels);
    const TexelPacker packer{{file.extension() == ".png"}, rounding};
    for (std::size_t i = 0; i < count; ++i) {
        const float* const normal = with_normals ? normals->level_texels(0, 0) + 4 * i : nullptr;
        packer.pack(map.level_texels(0, 0) + 2 * i, normal, packing, &values[i * channels]);
    }
    write_values(file, map, channels, values, writing);
}

PackedMap load_packed(const std::filesystem::path& file, Packing packing, const std::string& key) {
    const Image image = load_image(file, NotFinite::refuse, key);
    const bool depth = packing == Packing::normal_cone_depth;
    const int least = depth ? 4 : 2;
    if (image.channels < least || image.luminance)
        throw InputError(file.string(), key, fmt::format("{} channels", image.channels),
                         !depth ? "height in red, cones in green" : "red, green, blue and alpha");
    std::vector<float> heights, cones;
    for (std::size_t i = 0; i < image.values.size(); i += image.channels) {
        const float* const texel = &image.values[i];
        const float h = depth ? 1.0f - texel[3] : texel[0];
        heights.push_back(h);
        cones.push_back(h);
        cones.push_back(packing == Packing::height_sqrt_cone ? texel[1] * texel[1]
                        : depth                              ? texel[2]
                                                             : texel[1]);
    }
    return {make_plain(image.width, image.height, 1, std::move(heights), file),
            make_plain(image.width, image.height, 2, std::move(cones), file)};
}

}  // namespace quadrel
