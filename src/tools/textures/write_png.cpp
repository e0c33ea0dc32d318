#include <png.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>

#include "colour.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

/// libpng's simplified interface takes 16-bit data as linear light only; the full one writes bytes
/// as they are.
struct PngFormat {
    int bit_depth, colour_type;
    bool srgb;
};

[[noreturn]] void fail(png_structp, png_const_charp message) { throw std::runtime_error(message); }

struct PngWriter {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
    png_infop info = png_create_info_struct(png);
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

/// `bytes`: rows of `row_bytes`, 16-bit samples most significant byte first.
void write_png(const std::filesystem::path& file, int width, int height, PngFormat format,
               std::vector<std::uint8_t>& bytes) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "wb"),
                                                                 std::fclose);
    if (!stream) throw std::runtime_error("cannot write " + file.string());
    PngWriter writer;
    png_init_io(writer.png, stream.get());
    png_set_compression_level(writer.png, 9);
    png_set_IHDR(writer.png, writer.info, width, height, format.bit_depth, format.colour_type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (format.srgb) png_set_sRGB(writer.png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(writer.png, writer.info);
    const std::size_t row_bytes = bytes.size() / height;
    for (int y = 0; y < height; ++y) png_write_row(writer.png, bytes.data() + y * row_bytes);
    png_write_end(writer.png, writer.info);
    if (std::fflush(stream.get()) != 0) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

void write_height_png(const std::filesystem::path& file, const Grid<double>& height) {
    std::vector<std::uint8_t> bytes;
    for (const double h : height.values) {
        const int code = static_cast<int>(std::floor(saturate(h) * 65535 + 0.5));
        bytes.push_back(static_cast<std::uint8_t>(code >> 8));
        bytes.push_back(static_cast<std::uint8_t>(code & 255));
    }
    write_png(file, height.width, height.height, {16, PNG_COLOR_TYPE_GRAY, false}, bytes);
}

void write_colour_png(const std::filesystem::path& file, const Grid<glm::dvec4>& colour) {
    std::vector<std::uint8_t> bytes;
    for (const glm::dvec4& c : colour.values)
        for (int i = 0; i < 3; ++i) bytes.push_back(static_cast<std::uint8_t>(srgb_code(c[i])));
    write_png(file, colour.width, colour.height, {8, PNG_COLOR_TYPE_RGB, true}, bytes);
}

}  // namespace quadrel::textures
