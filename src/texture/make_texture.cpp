// From images to mip chains.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "quadrel/check.hpp"
#include "quadrel/error.hpp"
#include "quadrel/texture/texture.hpp"
#include "text/hash.hpp"
#include "texture/make_texture.hpp"
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

/// Makes the levels of one face, each rounded to the texture's format and stored while its rows are
/// at hand for the next.
class FaceFiller {
  public:
    FaceFiller(Texture& texture, int face, const std::vector<double>& units, MipRule rule)
        : texture_(texture), view_(texture.view()), face_(face), units_(units), rule_(rule) {}

    void fill(const LevelRows& texels) {
        if (view_.levels == 1) return store_level(0, texels);
        auto level = reduce(0, texels);
        for (int i = 1; i + 1 < view_.levels; ++i) level = reduce(i, *level);
        store_level(view_.levels - 1, *level);
    }

  private:
    void store_row(int level, int y, const double* row) {
        const int width = view_.width[level], channels = view_.channels;
        float* const out =
            texture_.level_texels(level, face_) + static_cast<std::ptrdiff_t>(y) * width * channels;
        const bool alike = std::count(units_.begin(), units_.end(), units_[0]) == channels;
        if (alike && texture_.format() != TexelFormat::srgb8)
            return store_and_decode(row, out, width * channels, 1, units_[0], texture_.format(),
                                    false);
        for (int c = 0; c < channels; ++c)
            store_and_decode(row + c, out + c, width, channels, units_[static_cast<std::size_t>(c)],
                             texture_.format(), c == 3);
    }

    /// Calls f(first, last) on rows that together are `height`, in parallel; not so few at a time
    /// that it is not worth it.
    template <class F>
    void in_rows(int level, int height, const F& f) const {
        constexpr int worth = 1 << 14;  // values
        const int grain = std::max(1, worth / (view_.width[level] * view_.channels));
        tbb::parallel_for(tbb::blocked_range<int>(0, height, grain),
                          [&](const auto& rows) { f(rows.begin(), rows.end()); });
    }

    void store_level(int level, const LevelRows& from) {
        in_rows(level, view_.height[level], [&](int first, int last) {
            std::vector<double> scratch;
            for (int y = first; y < last; ++y) store_row(level, y, from.row(y, scratch));
        });
    }

    /// Stores a level and gives the next.
    std::unique_ptr<WideLevel> reduce(int level, const LevelRows& from) {
        auto to = std::make_unique<WideLevel>(view_.width[level + 1], view_.height[level + 1],
                                              view_.channels);
        if (rule_ == MipRule::box) {
            in_rows(level + 1, to->height,
                    [&](int first, int last) { store_and_box(level, from, *to, first, last); });
            return to;
        }
        store_level(level, from);
        in_rows(level + 1, to->height, [&](int first, int last) {
            for (int y = first; y < last; ++y)
                area_row(from, view_.width[level], view_.height[level], *to, y);
        });
        return to;
    }

    /// Rows `first` to `last - 1` of `to`, and the rows that these are made of; the last one takes
    /// the odd row with it, which the box rule leaves out.
    void store_and_box(int level, const LevelRows& from, WideLevel& to, int first, int last) {
        const int height = view_.height[level];
        std::vector<double> above, below;
        for (int y = first; y < last; ++y) {
            const double* const upper = from.row(2 * y, above);
            store_row(level, 2 * y, upper);
            const double* lower = upper;
            if (2 * y + 1 < height) store_row(level, 2 * y + 1, lower = from.row(2 * y + 1, below));
            box_row(upper, lower, view_.width[level], to, y);
        }
        if (last == to.height && 2 * last < height)
            store_row(level, 2 * last, from.row(2 * last, above));
    }

    Texture& texture_;
    const TextureView& view_;
    const int face_;
    const std::vector<double>& units_;
    const MipRule rule_;
};

void fill_face(Texture& texture, int face, const SourceTexels& texels, MipRule rule) {
    FaceFiller(texture, face, texels.units(), rule).fill(texels);
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

std::shared_ptr<const Texture> make_texture(const Image& image, const TextureOptions& options,
                                            const std::string& content) {
    const auto swizzle = resolve_swizzle(options.swizzle, image, options.key);
    const auto texture =
        empty_texture(image, static_cast<int>(swizzle.size()), 1, options, content);
    fill_face(*texture, 0, SourceTexels(image, swizzle, options.srgb, options.flip_v),
              options.mip_rule);
    return texture;
}

std::shared_ptr<const Texture> make_texture(const Image& image, const TextureOptions& options) {
    return make_texture(image, options, content_hash(image));
}

std::shared_ptr<const Texture> make_cube_texture(const std::array<Image, 6>& faces,
                                                 const TextureOptions& options,
                                                 const std::string& content) {
    for (const Image& face : faces) check_face(face, faces[0], options.key);
    const int channels =
        static_cast<int>(resolve_swizzle(options.swizzle, faces[0], options.key).size());
    const auto texture = empty_texture(faces[0], channels, 6, options, content);
    std::array<std::vector<SwizzleEntry>, 6> swizzles;
    for (std::size_t face = 0; face < 6; ++face) {
        swizzles[face] = resolve_swizzle(options.swizzle, faces[face], options.key);
        if (static_cast<int>(swizzles[face].size()) != channels) {
            throw InputError(faces[face].file.string(), options.key,
                             fmt::format("{} channels", swizzles[face].size()),
                             fmt::format("{}, as the first face has", channels));
        }
    }
    tbb::parallel_for(0, 6, [&](int face) {
        const auto i = static_cast<std::size_t>(face);
        fill_face(*texture, face, SourceTexels(faces[i], swizzles[i], options.srgb, options.flip_v),
                  options.mip_rule);
    });
    return texture;
}

std::shared_ptr<const Texture> make_cube_texture(const std::array<Image, 6>& faces,
                                                 const TextureOptions& options) {
    std::string hashes;
    for (const Image& face : faces) hashes += content_hash(face);
    return make_cube_texture(faces, options, hashes);
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
