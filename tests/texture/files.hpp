// Small image files made byte by byte, so that no image library vouches for itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadrel::test {

using Bytes = std::string;

inline void append_big(Bytes& to, std::uint64_t value, int bytes) {
    for (int i = bytes - 1; i >= 0; --i) to.push_back(static_cast<char>(value >> (8 * i) & 255));
}
inline void append_little(Bytes& to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to.push_back(static_cast<char>(value >> (8 * i) & 255));
}

/// CRC-32 of PNG chunks (ISO 3309).
inline std::uint32_t crc32(const Bytes& bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return ~crc;
}

inline void append_chunk(Bytes& png, const Bytes& type, const Bytes& data) {
    append_big(png, static_cast<std::uint32_t>(data.size()), 4);
    png += type + data;
    append_big(png, crc32(type + data), 4);
}

/// The zlib stream (RFC 1950) of one stored block.
inline Bytes store_zlib(const Bytes& data) {
    Bytes out = "\x78\x01\x01";
    append_little(out, static_cast<std::uint32_t>(data.size()), 2);
    append_little(out, ~static_cast<std::uint32_t>(data.size()), 2);
    out += data;
    std::uint32_t a = 1, b = 0;
    for (const char byte : data) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    append_big(out, b << 16 | a, 4);
    return out;
}

/// PNG colour types (PNG specification, 11.2.2).
enum class PngColour { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

/// `rows`: the bytes of all rows; `palette` in triples.
inline Bytes make_png(int width, int height, int depth, PngColour colour, const Bytes& rows,
                      const Bytes& palette = "") {
    Bytes png("\x89PNG\r\n\x1a\n", 8), header, filtered;
    append_big(header, static_cast<std::uint32_t>(width), 4);
    append_big(header, static_cast<std::uint32_t>(height), 4);
    header += {static_cast<char>(depth), static_cast<char>(colour), 0, 0, 0};
    append_chunk(png, "IHDR", header);
    if (!palette.empty()) append_chunk(png, "PLTE", palette);
    const std::size_t stride = rows.size() / static_cast<std::size_t>(height);
    for (std::size_t at = 0; at < rows.size(); at += stride) {
        filtered += '\0' + rows.substr(at, stride);
    }
    append_chunk(png, "IDAT", store_zlib(filtered));
    append_chunk(png, "IEND", "");
    return png;
}

/// An uncompressed 8-bit grey TIFF, one row a strip, pixels last in the file.
inline Bytes make_tiff(int width, int height, const Bytes& pixels, int orientation = 1) {
    const auto w = static_cast<std::uint32_t>(width), h = static_cast<std::uint32_t>(height);
    constexpr std::uint32_t entries = 10, list = 8 + 2 + 12 * entries + 4;
    Bytes tiff("II*\0\x08\0\0\0", 8);
    append_little(tiff, entries, 2);
    const auto entry = [&](std::uint32_t tag, std::uint32_t count, std::uint32_t value) {
        append_little(tiff, tag, 2);
        append_little(tiff, 4, 2);  // LONG
        append_little(tiff, count, 4);
        append_little(tiff, value, 4);
    };
    entry(256, 1, w);     // ImageWidth
    entry(257, 1, h);     // ImageLength
    entry(258, 1, 8);     // BitsPerSample
    entry(259, 1, 1);     // Compression: none
    entry(262, 1, 1);     // PhotometricInterpretation: black is zero
    entry(273, h, list);  // StripOffsets
    entry(274, 1, static_cast<std::uint32_t>(orientation));
    entry(277, 1, 1);             // SamplesPerPixel
    entry(278, 1, 1);             // RowsPerStrip
    entry(279, h, list + 4 * h);  // StripByteCounts
    append_little(tiff, 0, 4);
    for (std::uint32_t y = 0; y < h; ++y) append_little(tiff, list + 8 * h + y * w, 4);
    for (std::uint32_t y = 0; y < h; ++y) append_little(tiff, w, 4);
    return tiff + pixels;
}

/// 24x24 grey noise, made with: oiiotool --create 24x24 1 --noise:type=uniform:min=0.2:max=0.8
/// -d uint8 --compression jpeg:40, application markers removed.
inline const unsigned char noise_jpeg[] = {
    255, 216, 255, 219, 0,   67,  0,   20,  14,  15,  18,  15,  13,  20,  18,  16,  18,  23,  21,
    20,  24,  30,  50,  33,  30,  28,  28,  30,  61,  44,  46,  36,  50,  73,  64,  76,  75,  71,
    64,  70,  69,  80,  90,  115, 98,  80,  85,  109, 86,  69,  70,  100, 136, 101, 109, 119, 123,
    129, 130, 129, 78,  96,  141, 151, 140, 125, 150, 115, 126, 129, 124, 255, 192, 0,   11,  8,
    0,   24,  0,   24,  1,   1,   17,  0,   255, 196, 0,   31,  0,   0,   1,   5,   1,   1,   1,
    1,   1,   1,   0,   0,   0,   0,   0,   0,   0,   0,   1,   2,   3,   4,   5,   6,   7,   8,
    9,   10,  11,  255, 196, 0,   181, 16,  0,   2,   1,   3,   3,   2,   4,   3,   5,   5,   4,
    4,   0,   0,   1,   125, 1,   2,   3,   0,   4,   17,  5,   18,  33,  49,  65,  6,   19,  81,
    97,  7,   34,  113, 20,  50,  129, 145, 161, 8,   35,  66,  177, 193, 21,  82,  209, 240, 36,
    51,  98,  114, 130, 9,   10,  22,  23,  24,  25,  26,  37,  38,  39,  40,  41,  42,  52,  53,
    54,  55,  56,  57,  58,  67,  68,  69,  70,  71,  72,  73,  74,  83,  84,  85,  86,  87,  88,
    89,  90,  99,  100, 101, 102, 103, 104, 105, 106, 115, 116, 117, 118, 119, 120, 121, 122, 131,
    132, 133, 134, 135, 136, 137, 138, 146, 147, 148, 149, 150, 151, 152, 153, 154, 162, 163, 164,
    165, 166, 167, 168, 169, 170, 178, 179, 180, 181, 182, 183, 184, 185, 186, 194, 195, 196, 197,
    198, 199, 200, 201, 202, 210, 211, 212, 213, 214, 215, 216, 217, 218, 225, 226, 227, 228, 229,
    230, 231, 232, 233, 234, 241, 242, 243, 244, 245, 246, 247, 248, 249, 250, 255, 218, 0,   8,
    1,   1,   0,   0,   63,  0,   91,  118, 195, 146, 222, 91,  21,  227, 160, 10,  49,  211, 175,
    67,  212, 99,  142, 5,   61,  157, 204, 10,  229, 84,  244, 200, 233, 146, 51,  142, 123, 244,
    199, 245, 238, 90,  142, 35,  46,  101, 44,  88,  42,  134, 81,  206, 78,  238, 8,   63,  64,
    120, 30,  132, 211, 80,  77,  33,  82,  2,   238, 118, 82,  10,  114, 0,   4,   146, 112, 127,
    207, 79,  122, 100, 171, 26,  9,   76,  126, 97,  76,  5,   80,  195, 110, 7,   208, 254, 61,
    191, 90,  89,  3,   109, 95,  40,  130, 232, 14,  238, 64,  28,  118, 207, 29,  56,  255, 0,
    235, 142, 4,   145, 170, 121, 242, 32,  12,  70,  65,  43,  150, 3,   28,  241, 211, 177, 199,
    191, 21,  10,  202, 12,  70,  38,  42,  14,  240, 85,  118, 238, 5,   115, 207, 78,  156, 99,
    183, 24,  227, 217, 222, 83,  50,  237, 118, 98,  118, 252, 193, 70,  114, 115, 233, 220, 12,
    118, 207, 36,  226, 191, 255, 217,
};

}  // namespace quadrel::test
