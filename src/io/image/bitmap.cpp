// Bitmaps packed by runs, "Bitmap Compression" in the Windows GDI reference: BI_RLE8 and BI_RLE4.
// OpenImageIO (2.4) mixes up the columns of those whose palette is grey, as height maps have it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "file/read_file.hpp"
#include "io/image/readers.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
};

class Bitmap {
  public:
    Bitmap(std::string bytes, const std::string& file, const std::string& key)
        : bytes_(std::move(bytes)), file_(file), key_(key) {}

    bool is_packed() const {
        if (bytes_.size() < 54 || number(14, 4) < 40) return false;
        const std::int64_t bits = number(28, 2), compression = number(30, 4);
        return (compression == 1 && bits == 8) || (compression == 2 && bits == 4);
    }

    Image read() {
        width_ = signed_number(18);
        height_ = signed_number(22);
        if (height_ < 0) fail("rows from the top in a bitmap packed by runs");
        check_image_size(width_, height_, 3, file_, key_);
        // A pair of bytes fills at most 255 pixels; skipped ones take no bytes at all, but marks.
        if (width_ * height_ > 512 * static_cast<std::int64_t>(bytes_.size()))
            fail(fmt::format("{} x {} pixels in {} bytes", width_, height_, bytes_.size()));
        read_palette();
        indices_.assign(static_cast<std::size_t>(width_ * height_), 0);
        at_ = static_cast<std::size_t>(number(10, 4));
        while (step()) {
        }
        return to_image();
    }

  private:
    [[noreturn]] void fail(const std::string& found) const {
        throw InputError(file_, key_, found, "a complete bitmap");
    }

    std::int64_t number(std::size_t at, int size) const {
        std::int64_t value = 0;
        for (int i = size - 1; i >= 0; --i)
            value =
                value << 8 | static_cast<unsigned char>(bytes_[at + static_cast<std::size_t>(i)]);
        return value;
    }
    std::int64_t signed_number(std::size_t at) const {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(number(at, 4)));
    }

    int next_byte() {
        if (at_ >= bytes_.size()) fail("the end of the file within the pixels");
        return static_cast<unsigned char>(bytes_[at_++]);
    }

    bool has_8_bits() const { return number(30, 4) == 1; }

    void read_palette() {
        const std::size_t most = has_8_bits() ? 256 : 16;
        std::int64_t colours = number(46, 4);
        if (colours == 0) colours = static_cast<std::int64_t>(most);
        const std::size_t start = 14 + static_cast<std::size_t>(number(14, 4));
        if (colours > static_cast<std::int64_t>(most) ||
            start + 4 * static_cast<std::size_t>(colours) > bytes_.size())
            fail(fmt::format("a palette of {} colours", colours));
        for (std::size_t i = 0; i < static_cast<std::size_t>(colours); ++i) {
            const auto byte = [&](std::size_t c) {
                return static_cast<std::uint8_t>(bytes_[start + 4 * i + c]);
            };
            palette_.push_back({byte(2), byte(1), byte(0)});
        }
    }

    void put(int index) {
        if (x_ >= width_ || y_ >= height_)
            fail(fmt::format("a run beyond column {} of row {} from the bottom", x_, y_));
        if (index >= static_cast<int>(palette_.size()))
            fail(fmt::format("colour {} of {}", index, palette_.size()));
        indices_[static_cast<std::size_t>((height_ - 1 - y_) * width_ + x_)] =
            static_cast<std::uint8_t>(index);
        ++x_;
    }

    /// The k-th of several pixels that share bytes two by two, or one a byte.
    int pixel_of(int byte, int k) const {
        if (has_8_bits()) return byte;
        return k % 2 == 0 ? byte >> 4 : byte & 15;
    }

    /// False at the end of the bitmap.
    bool step() {
        const int count = next_byte(), value = next_byte();
        for (int k = 0; k < count; ++k) put(pixel_of(value, k));
        if (count > 0) return true;
        if (value == 1) return false;
        if (value == 0) {
            x_ = 0;
            ++y_;
        } else if (value == 2) {
            x_ += next_byte();
            y_ += next_byte();
        } else {
            read_plain(value);
        }
        return true;
    }

    /// Pixels as they are, padded to pairs of bytes.
    void read_plain(int count) {
        const std::size_t start = at_;
        int byte = 0;
        for (int k = 0; k < count; ++k) {
            if (has_8_bits() || k % 2 == 0) byte = next_byte();
            put(pixel_of(byte, k));
        }
        if ((at_ - start) % 2 != 0) next_byte();
    }

    /// Grey palettes give one channel, as OpenImageIO has it for other bitmaps of 8 bits.
    Image to_image() const {
        const bool grey =
            has_8_bits() && std::all_of(palette_.begin(), palette_.end(),
                                        [](const Rgb& c) { return c.r == c.g && c.g == c.b; });
        Image image;
        image.width = static_cast<int>(width_);
        image.height = static_cast<int>(height_);
        image.channels = grey ? 1 : 3;
        image.luminance = grey;
        image.format = TexelFormat::unorm8;
        image.values.reserve(indices_.size() * static_cast<std::size_t>(image.channels));
        for (const std::uint8_t index : indices_) {
            const Rgb colour = palette_[index];
            for (const std::uint8_t code : {colour.r, colour.g, colour.b}) {
                image.values.push_back(static_cast<float>(code) / 255.0f);
                if (grey) break;
            }
        }
        return image;
    }

    std::string bytes_;
    const std::string& file_;
    const std::string& key_;
    std::int64_t width_ = 0, height_ = 0, x_ = 0, y_ = 0;  ///< y from the bottom
    std::size_t at_ = 0;
    std::vector<Rgb> palette_;
    std::vector<std::uint8_t> indices_;
};

}  // namespace

std::optional<Image> read_packed_bitmap(const std::string& file, const std::string& key) {
    Bitmap bitmap(read_whole_file(file), file, key);
    if (!bitmap.is_packed()) return std::nullopt;
    return bitmap.read();
}

}  // namespace quadrel
