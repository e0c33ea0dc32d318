// From images to mip chains.
#include <fmt/format.h>

#include <algorithm>

#include "quadrel/check.hpp"
#include "quadrel/error.hpp"
#include "quadrel/texture/texture.hpp"
#include "text/hash.hpp"
#include "texture/mip.hpp"
#include "texture/source_texels.hpp"
#include "texture/texel_format.hpp"

namespace quadrel {

namespace {

TexelFormat chosen_format(const Image& image, const TextureOptions& options) {
    if (options.format) return *options.format;
    if (!options.srgb) return image.format;
    if (image.format == TexelFormat::unorm8) return TexelFormat::srgb8;
    // There is no 16-bit sRGB format, and linear unorm16 would lose the dark codes.
    return image.format == TexelFormat::unorm16 ? TexelFormat::float32 : image.format;
}

[[noreturn]] void refuse_size(const Image& image, const std::string& key, const char* expected) {
    throw InputError(image.file.string(), key,
                     fmt::format("{} x {} texels", image.width, image.height), expected);
}

/// Levels are laid out one after the other, each at a multiple of 64 bytes.
TextureView make_layout(const Image& image, int channels, int faces,
                        const TextureOptions& options) {
    if (std::min(image.width, image.height) < 1 ||
        std::max(image.width, image.height) > max_image_side) {
        refuse_size(image, options.key, "1 to 65536 texels a side");
    }
    TextureView view{};
    view.channels = channels;
    view.faces = faces;
    view.levels =
        options.mip_rule == MipRule::none ? 1 : full_mip_levels(image.width, image.height);
    std::int64_t offset = 0;
    for (int level = 0; level < view.levels; ++level) {
        view.width[level] = std::max(1, image.width >> level);
        view.height[level] = std::max(1, image.height >> level);
        view.offset[level] = static_cast<std::int32_t>(std::min(offset, max_texture_floats));
        offset += std::int64_t(view.width[level]) * view.height[level] * channels * faces;
        offset = (offset + 15) / 16 * 16;
    }
    if (offset > max_texture_floats) {
        refuse_size(image, options.key, "at most 2^29 floats, mip levels included");
    }
    return view;
}

/// Rounds a level to the texture's format and stores it. `source(x, y, c)` is in multiples of
/// 1 / texels.unit(c).
template <class Source>
void store_level(Texture& texture, int level, int face, const Source& source,
                 const SourceTexels& texels) {
    const TextureView& view = texture.view();
    float* const to = texture.level_texels(level, face);
    const int width = view.width[level], channels = view.channels;
    tbb::parallel_for(0, view.height[level], [&](int y) {
        float* out = to + static_cast<std::size_t>(y) * width * channels;
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                *out++ =
                    store_and_decode(source(x, y, c), texels.unit(c), texture.format(), c == 3);
            }
        }
    });
}

void fill_face(Texture& texture, int face, const SourceTexels& texels, MipRule rule) {
    const TextureView& view = texture.view();
    store_level(texture, 0, face, texels, texels);
    if (view.levels == 1) return;
    WideLevel finer = reduce_level(texels, view.width[0], view.height[0], view.channels, rule);
    store_level(texture, 1, face, finer, texels);
    for (int level = 2; level < view.levels; ++level) {
        finer = reduce_level(finer, finer.width, finer.height, view.channels, rule);
        store_level(texture, level, face, finer, texels);
    }
}

std::shared_ptr<Texture> empty_texture(const Image& image, int channels, int faces,
                                       const TextureOptions& options, const std::string& hash) {
    return std::make_shared<Texture>(make_layout(image, channels, faces, options),
                                     chosen_format(image, options), texture_id(hash, options));
}

void check_face(const Image& face, const Image& first, const std::string& key) {
    if (face.width != face.height) refuse_size(face, key, "a square cube map face");
    if (face.width != first.width) refuse_size(face, key, "cube map faces of one size");
    if (face.format != first.format) {
        throw InputError(face.file.string(), key,
                         fmt::format("{} values", format_name(face.format)),
                         fmt::format("{}, as the first face has", format_name(first.format)));
    }
}

}  // namespace

std::shared_ptr<const Texture> make_texture(const Image& image, const TextureOptions& options) {
    const auto swizzle = resolve_swizzle(options.swizzle, image, options.key);
    const auto texture =
        empty_texture(image, static_cast<int>(swizzle.size()), 1, options, content_hash(image));
    const SourceTexels texels(image, swizzle, options.srgb, options.flip_v);
    fill_face(*texture, 0, texels, options.mip_rule);
    return texture;
}

std::shared_ptr<const Texture> make_cube_texture(const std::array<Image, 6>& faces,
                                                 const TextureOptions& options) {
    std::string hashes;
    for (const Image& face : faces) {
        check_face(face, faces[0], options.key);
        hashes += content_hash(face);
    }
    const int channels =
        static_cast<int>(resolve_swizzle(options.swizzle, faces[0], options.key).size());
    const auto texture = empty_texture(faces[0], channels, 6, options, hashes);
    for (int face = 0; face < 6; ++face) {
        const Image& image = faces[static_cast<std::size_t>(face)];
        const auto swizzle = resolve_swizzle(options.swizzle, image, options.key);
        if (static_cast<int>(swizzle.size()) != channels) {
            throw InputError(image.file.string(), options.key,
                             fmt::format("{} channels", swizzle.size()),
                             fmt::format("{}, as the first face has", channels));
        }
        fill_face(*texture, face, SourceTexels(image, swizzle, options.srgb, options.flip_v),
                  options.mip_rule);
    }
    return texture;
}

std::string content_hash(const Image& image) {
    std::string bytes =
        fmt::format("{} {} {} {} {}\n", image.width, image.height, image.channels,
                    format_name(image.format), image.luminance ? "luminance" : "colour");
    bytes.append(reinterpret_cast<const char*>(image.values.data()),
                 image.values.size() * sizeof(float));
    return sha256_hex(bytes);
}

std::string texture_id(const std::string& content_hash, const TextureOptions& options) {
    const std::string_view format = options.format ? format_name(*options.format) : "own";
    return sha256_hex(fmt::format("{} swizzle={} srgb={} format={} mips={} flip={}", content_hash,
                                  options.swizzle, options.srgb, format,
                                  static_cast<int>(options.mip_rule), options.flip_v));
}

}  // namespace quadrel
