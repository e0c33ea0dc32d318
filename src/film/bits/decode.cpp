#include <fmt/format.h>

#include <map>

#include "film/bits/codes.hpp"
#include "quadrel/error.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

/// What `bits` stands for, by how an image is stored.
BitLayout layout_of(const Codes& codes) {
    switch (codes.storage()) {
        case Storage::unorm8:
            if (!codes.has("B"))
                codes.reject(fmt::format("channels {}", codes.names()), "R G B A, or R G B");
            if (!codes.has("A")) return BitLayout::rgb8;
            return codes.is_everywhere("A", 255) && codes.has_check_bytes() ? BitLayout::rgb8
                                                                            : BitLayout::rgba8;
        case Storage::unorm16:
            return codes.are_of_ten_bits() ? BitLayout::rgb10a2 : BitLayout::rg16;
        case Storage::uint32:
            return BitLayout::rg16;
        case Storage::half:
        case Storage::float32:
            break;
    }
    codes.reject(fmt::format("values of {}, which may be codes of any layout",
                             storage_name(codes.storage())),
                 "a layout by name, as rgba8:hit.U");
}

/// Of half the values, codes of 16 bits are none.
void check_storage(const Codes& codes, BitLayout layout) {
    const Storage storage = codes.storage();
    const bool wide = layout == BitLayout::rg16 || layout == BitLayout::rgb10a2;
    if (wide && storage == Storage::unorm8)
        codes.reject("codes of 8 bits",
                     fmt::format("16 bits, for the layout {}", bit_layout_name(layout)));
    if (layout == BitLayout::rg16 && storage == Storage::half)
        codes.reject("halves, which hold no codes of 16 bits", "16-bit integers or floats");
}

/// An alpha that a screenshot has made opaque. (Bits that are all set are all in R, G and B, too.)
void check_alpha(const Codes& codes) {
    if (!codes.has("A"))
        codes.reject(fmt::format("channels {} alone", codes.names()),
                     "also A; what drops alpha carries the layout rgb8");
    if (codes.is_everywhere("A", 255) && !codes.is_everywhere("R", 255))
        codes.reject("alpha 255 in every pixel, which is what a screenshot makes of it",
                     "bits 24 to 31; what drops alpha carries the layout rgb8");
}

/// 16 bits and whether they are those that they should be.
std::uint32_t half_at(const Codes& codes, std::size_t i, bool is_high) {
    const Storage storage = codes.storage();
    if (storage == Storage::unorm16 || storage == Storage::uint32) return codes.at("R", 16, i);
    const std::uint32_t half = codes.at("R", 8, i) | codes.at("G", 8, i) << 8;
    const std::uint32_t check = codes.at("B", 8, i);
    if (check == check_byte(half, is_high)) return half;
    if (check == check_byte(half, !is_high))
        codes.reject(i, "B", fmt::format("the check byte of bits {}", is_high ? "0-15" : "16-31"),
                     fmt::format("that of bits {}", is_high ? "16-31" : "0-15"));
    codes.reject(i, "B", fmt::format("the check byte {}", check),
                 fmt::format("{}: codes as the shader wrote them, without sRGB, gamma, blending, "
                             "dithering, scaling, another order of channels or lossy compression",
                             check_byte(half, is_high)));
}

std::uint32_t value_at(const Codes& codes, BitLayout layout, std::size_t i) {
    switch (layout) {
        case BitLayout::rgba8:
            return codes.at("R", 8, i) | codes.at("G", 8, i) << 8 | codes.at("B", 8, i) << 16 |
                   codes.at("A", 8, i) << 24;
        case BitLayout::rg16:
            return codes.at("R", 16, i) | codes.at("G", 16, i) << 16;
        case BitLayout::rgb10a2:
            return codes.at("R", 10, i) | codes.at("G", 10, i) << 10 | codes.at("B", 10, i) << 20 |
                   codes.at("A", 2, i) << 30;
        case BitLayout::high:
            return half_at(codes, i, true) << 16;
        default:
            return half_at(codes, i, false);
    }
}

/// Tiles of one size, side by side or one above the other.
class Tiles {
  public:
    Tiles(const Codes& codes, int count, const Window& frame)
        : width_(frame.width()), height_(frame.height()), row_(codes.width()) {
        beside_ = codes.width() == width_ * count && codes.height() == height_;
        if (beside_ || (codes.width() == width_ && codes.height() == height_ * count)) return;
        const std::string each = fmt::format("{} x {}, the reference's frame", width_, height_);
        codes.reject(fmt::format("{} x {} pixels", codes.width(), codes.height()),
                     count == 1 ? each : fmt::format("{} tiles of {}", count, each));
    }
    /// Where a tile has the pixel `i` of the frame, row by row.
    std::size_t index(int tile, std::size_t i) const {
        const auto width = static_cast<std::size_t>(width_),
                   number = static_cast<std::size_t>(tile);
        if (!beside_) return number * width * static_cast<std::size_t>(height_) + i;
        return i / width * static_cast<std::size_t>(row_) + number * width + i % width;
    }

  private:
    int width_, height_, row_;
    bool beside_ = true;
};

/// Channels as they gather, and which halves of each are there.
struct Gathered {
    Film film;
    std::map<std::string, unsigned> halves;  ///< 1: low, 2: high
};

Plane& plane_for(const std::string& channel, unsigned halves, const Film& reference,
                 Gathered& gathered) {
    const Plane* const model = reference.find(channel);
    if (model == nullptr) {
        std::vector<std::string> known;
        for (const Plane& plane : reference.planes) known.push_back(plane.name);
        throw UsageError("--decode: the reference has no channel \"" + channel + "\", expected " +
                         one_of(channel, known));
    }
    unsigned& present = gathered.halves[channel];
    if ((present & halves) != 0)
        throw UsageError("--decode: \"" + channel + "\" comes twice, expected each channel once");
    present |= halves;
    if (Plane* const plane = gathered.film.find(channel)) return *plane;
    return gathered.film.add(channel, model->type);
}

void gather(const BitImage& source, const Film& reference, Gathered& gathered) {
    if (source.image.film.planes.empty())
        throw InputError(source.image.file.string(), "", "no channels", "an image");
    const Codes codes(source.image);
    BitLayout layout = source.carries.layout;
    if (layout == BitLayout::automatic) layout = layout_of(codes);
    check_storage(codes, layout);
    if (layout == BitLayout::rgba8) check_alpha(codes);
    const bool split = layout == BitLayout::rgb8;
    const int tiles = (split ? 2 : 1) * static_cast<int>(source.carries.channels.size());
    const Tiles place(codes, tiles, reference.frame);
    int tile = 0;
    for (const std::string& channel : source.carries.channels)
        for (const BitLayout part :
             split ? std::vector{BitLayout::low, BitLayout::high} : std::vector{layout}) {
            const unsigned halves = part == BitLayout::low ? 1 : part == BitLayout::high ? 2 : 3;
            Plane& plane = plane_for(channel, halves, reference, gathered);
            for (std::size_t i = 0; i < plane.bits.size(); ++i)
                plane.bits[i] |= value_at(codes, part, place.index(tile, i));
            ++tile;
        }
}

}  // namespace

ComparableImage decode_bits(std::span<const BitImage> images, const Film& reference) {
    Gathered gathered{{reference.frame, reference.frame, {}}, {}};
    for (const BitImage& image : images) gather(image, reference, gathered);
    for (const auto& [channel, halves] : gathered.halves)
        if (halves != 3)
            throw UsageError("--decode: \"" + channel +
                             "\" comes by half, expected low: and high:");
    ComparableImage result{
        images.empty() ? std::filesystem::path() : images[0].image.file, gathered.film, {}, {}};
    for (const Plane& plane : result.film.planes)
        result.stored[plane.name] =
            plane.type == ChannelType::uint32 ? Storage::uint32 : Storage::float32;
    canonicalize(result.film);
    return result;
}

}  // namespace quadrel
