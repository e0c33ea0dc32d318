#include "export/scene/texture_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "quadrel/check.hpp"
#include "quadrel/num/half.hpp"
#include "texture/texel_format.hpp"

namespace quadrel {
namespace {

struct FormatNames {
    const char *bits, *gl_suffix, *component_type, *dxgi_suffix, *webgpu_suffix;
};

FormatNames names_of(TexelFormat format) {
    switch (format) {
        case TexelFormat::unorm8:
        case TexelFormat::srgb8:
            return {"8", "", "UNSIGNED_BYTE", "UNORM", "unorm"};
        case TexelFormat::unorm16:
            return {"16", "", "UNSIGNED_SHORT", "UNORM", "unorm"};
        case TexelFormat::half:
            return {"16", "F", "HALF_FLOAT", "FLOAT", "float"};
        case TexelFormat::float32:
            break;
    }
    return {"32", "F", "FLOAT", "FLOAT", "float"};
}

template <class Number>
void append(std::string& bytes, Number number) {
    static_assert(std::endian::native == std::endian::little, "files are little-endian");
    std::array<char, sizeof(Number)> parts;
    std::memcpy(parts.data(), &number, sizeof number);
    bytes.append(parts.data(), parts.size());
}

void append_texel(std::string& bytes, float value, TexelFormat format, bool is_alpha) {
    const int max = max_code(format);
    if (format == TexelFormat::float32) return append(bytes, value);
    if (format == TexelFormat::half) {
        const std::uint16_t half = float_to_half(value);
        const float stored = half_to_float(half);
        QUADREL_CHECK(stored == value || (stored != stored && value != value), value);
        return append(bytes, half);
    }
    QUADREL_CHECK(store_and_decode(value, 1, format, is_alpha) == value, value);
    const int code = format == TexelFormat::srgb8 && !is_alpha ? encode_srgb8(value)
                                                               : encode_unorm(value, 1, max);
    if (max > 255)
        append(bytes, static_cast<std::uint16_t>(code));
    else
        append(bytes, static_cast<std::uint8_t>(code));
}

}  // namespace

namespace {

TexelLayout layout_of_channels(const Texture& texture, const std::string& language, int channels,
                               float lacking) {
    TexelLayout layout{texture.format(), channels, lacking, "", "", "", "", ""};
    if (layout.format == TexelFormat::unorm16 && (language == "glsl-es" || language == "wgsl"))
        layout.format = TexelFormat::float32;
    const bool is_srgb = layout.format == TexelFormat::srgb8;
    if (is_srgb) layout.channels = 4;
    static constexpr const char* components[] = {"R", "RG", "", "RGBA"};
    static constexpr const char* letters[] = {"R", "G", "B", "A"};
    const FormatNames names = names_of(layout.format);
    layout.components = layout.channels == 1 ? "RED" : components[layout.channels - 1];
    layout.component_type = names.component_type;
    layout.internal_format =
        is_srgb ? "SRGB8_ALPHA8"
                : std::string(components[layout.channels - 1]) + names.bits + names.gl_suffix;
    for (int c = 0; c < layout.channels; ++c) layout.dxgi += letters[c] + std::string(names.bits);
    layout.dxgi += std::string("_") + names.dxgi_suffix + (is_srgb ? "_SRGB" : "");
    static constexpr const char* lower[] = {"r", "rg", "", "rgba"};
    layout.webgpu = std::string(lower[layout.channels - 1]) + names.bits + names.webgpu_suffix +
                    (is_srgb ? "-srgb" : "");
    return layout;
}

}  // namespace

TexelLayout texel_layout(const Texture& texture, const std::string& language) {
    return layout_of_channels(texture, language, texture.view().channels, 0);
}

TexelLayout depth_layers_layout(const Texture& texture, const std::string& language) {
    return layout_of_channels(texture, language, 4, 1);
}

bool has_mip_sizes(const TextureView& view) {
    for (int level = 1; level < view.levels; ++level)
        if (view.width[level] != std::max(view.width[0] >> level, 1) ||
            view.height[level] != std::max(view.height[0] >> level, 1))
            return false;
    return true;
}

LevelSide side_of_level(const TextureView& view, int level) {
    if (has_mip_sizes(view)) return {view.width[level], view.height[level]};
    int side = 1 << (view.levels - 1);
    while (side < std::max(view.width[0], view.height[0])) side *= 2;
    return {side >> level, side >> level};
}

TextureView first_levels(const TextureView& view, int levels) {
    TextureView first = view;
    first.levels = levels;
    return first;
}

std::string level_bytes(const Texture& texture, int level, const TexelLayout& layout) {
    return level_bytes(texture, level, layout, side_of_level(texture.view(), level));
}

std::string level_bytes(const Texture& texture, int level, const TexelLayout& layout,
                        const LevelSide& side) {
    const TextureView& view = texture.view();
    const int width = view.width[level], height = view.height[level];
    const auto value_at = [&](const float* texel, int channel) {
        if (channel < view.channels) return texel[channel];
        return channel == 3 ? 1.0f : layout.lacking;
    };
    std::string bytes;
    for (int face = 0; face < view.faces; ++face) {
        const float* texel = texture.level_texels(level, face);
        for (int y = 0; y < side.height; ++y)
            for (int x = 0; x < side.width; ++x) {
                const bool inside = x < width && y < height;
                for (int c = 0; c < layout.channels; ++c)
                    append_texel(bytes, inside ? value_at(texel, c) : 0, layout.format, c == 3);
                if (inside) texel += view.channels;
            }
    }
    return bytes;
}

}  // namespace quadrel
