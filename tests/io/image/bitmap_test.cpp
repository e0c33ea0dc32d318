// Bitmaps packed by runs, DDS, and what is refused by name.
#include <functional>

#include "io/image/image_folder.hpp"
#include "quadrel/error.hpp"
#include "quadrel/texture/image.hpp"
#include "texture/planted.hpp"

namespace quadrel::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

struct Palette {
    int r, g, b;  ///< times the index
};
constexpr Palette grey{16, 16, 16}, coloured{16, 8, 1};

/// A bitmap of 5 x 3 pixels; packed as `data` if `compression` says so.
Bytes make_bitmap(int bits, int compression, const Palette& palette, const Bytes& data) {
    Bytes bytes = "BM";
    append_little(bytes, 0, 8);
    append_little(bytes, 14 + 40 + 4 * 16, 4);
    for (const auto& [value, size] : {std::pair{40u, 4}, {5u, 4}, {3u, 4}, {1u, 2}})
        append_little(bytes, value, size);
    append_little(bytes, static_cast<std::uint32_t>(bits), 2);
    append_little(bytes, static_cast<std::uint32_t>(compression), 4);
    append_little(bytes, static_cast<std::uint32_t>(data.size()), 4);
    for (const std::uint32_t value : {2835u, 2835u, 16u, 0u}) append_little(bytes, value, 4);
    for (int i = 0; i < 16; ++i)
        for (const int c : {palette.b * i, palette.g * i, palette.r * i, 0})
            bytes += static_cast<char>(c);
    return bytes + data;
}

/// From the bottom: runs; pixels as they are, with padding; a run.
const Bytes rows8(
    "\x03\x01\x02\x02\x00\x00\x00\x03\x04\x05\x06\x00\x02\x07\x00\x00\x05\x09\x00\x01", 20);
const std::vector<int> picture8 = {9, 9, 9, 9, 9, 4, 5, 6, 7, 7, 1, 1, 1, 2, 2};
/// The same in halves of bytes, a run of two colours first.
const Bytes rows4("\x05\x12\x00\x00\x00\x05\x34\x56\x70\x00\x00\x00\x05\x88\x00\x01", 16);
const std::vector<int> picture4 = {8, 8, 8, 8, 8, 3, 4, 5, 6, 7, 1, 2, 1, 2, 1};

AssertionResult shows(const Image& image, const std::vector<int>& picture, const Palette& palette) {
    if (image.width != 5 || image.height != 3) return AssertionFailure() << "the size";
    const int factors[] = {palette.r, palette.g, palette.b};
    for (std::size_t i = 0; i < picture.size(); ++i)
        for (int c = 0; c < image.channels; ++c) {
            const float value = image.values[i * static_cast<std::size_t>(image.channels) +
                                             static_cast<std::size_t>(c)];
            if (value != static_cast<float>(picture[i] * factors[c]) / 255.0f)
                return AssertionFailure() << "pixel " << i << ", channel " << c << ": " << value;
        }
    return AssertionSuccess();
}

Image damaged(Image image, Planted planted) {
    const std::vector<float> right = image.values;
    for (std::size_t i = 0; i < 15; ++i) {
        if (planted == Planted::rows_from_the_top) image.values[i] = right[(2 - i / 5) * 5 + i % 5];
        if (planted == Planted::columns_packed) image.values[i] = right[i / 5 * 5 + i % 5 / 3];
    }
    return image;
}

class Bitmaps : public ImageFolder {};

TEST_F(Bitmaps, RunsOfEightAndFourBits) {
    const Image heights = load_image(write("g.bmp", make_bitmap(8, 1, grey, rows8)));
    EXPECT_EQ(heights.channels, 1);
    EXPECT_EQ(heights.format, TexelFormat::unorm8);
    EXPECT_TRUE(shows(heights, picture8, grey));
    for (const Planted planted : {Planted::rows_from_the_top, Planted::columns_packed})
        EXPECT_FALSE(shows(damaged(heights, planted), picture8, grey));
    const Image colours = load_image(write("c.bmp", make_bitmap(8, 1, coloured, rows8)));
    EXPECT_EQ(colours.channels, 3);
    EXPECT_TRUE(shows(colours, picture8, coloured));
    for (const Palette& palette : {grey, coloured})
        EXPECT_TRUE(shows(load_image(write("h.bmp", make_bitmap(4, 2, palette, rows4))), picture4,
                          palette));
}

TEST_F(Bitmaps, SkippedPixelsAreColourZero) {
    const Bytes skips("\x01\x01\x00\x02\x02\x01\x02\x03\x00\x01", 10);
    EXPECT_TRUE(shows(load_image(write("s.bmp", make_bitmap(8, 1, grey, skips))),
                      {0, 0, 0, 0, 0, 0, 0, 0, 3, 3, 1, 0, 0, 0, 0}, grey));
}

TEST_F(Bitmaps, UnpackedOnesGoOn) {
    const Bytes rows(
        "\x01\x02\x03\x04\x05\0\0\0\x06\x07\x08\x09\x0a\0\0\0\x0b\x0c\x0d\x0e\x0f\0\0\0", 24);
    EXPECT_TRUE(shows(load_image(write("u.bmp", make_bitmap(8, 0, grey, rows))),
                      {11, 12, 13, 14, 15, 6, 7, 8, 9, 10, 1, 2, 3, 4, 5}, grey));
}

TEST_F(Bitmaps, DamagedOnesAreRefused) {
    for (std::size_t size = 0; size < rows8.size(); ++size)
        EXPECT_THROW(load_image(write("t.bmp", make_bitmap(8, 1, grey, rows8.substr(0, size)))),
                     InputError)
            << size;
    const Bytes beyond_row("\x06\x01\x00\x01", 4), beyond_palette("\x01\x10\x00\x01", 4);
    const Bytes beyond_top("\0\0\0\0\0\0\x01\x01\0\x01", 10);
    for (const Bytes& data : {beyond_row, beyond_palette, beyond_top})
        EXPECT_THROW(load_image(write("b.bmp", make_bitmap(8, 1, grey, data))), InputError);
}

Bytes make_dds(int side, std::uint32_t flags, const Bytes& four, std::uint32_t bits,
               const Bytes& data) {
    Bytes bytes = "DDS ";
    const auto size = static_cast<std::uint32_t>(side);
    for (const std::uint32_t value :
         {124u, 0x1007u, size, size, static_cast<std::uint32_t>(data.size()), 0u, 0u})
        append_little(bytes, value, 4);
    bytes += Bytes(44, '\0');
    append_little(bytes, 32, 4);
    append_little(bytes, flags, 4);
    bytes += four;
    const bool masks = bits == 32;
    for (const std::uint32_t value :
         {bits, masks ? 0xff0000u : 0u, masks ? 0xff00u : 0u, masks ? 0xffu : 0u,
          masks ? 0xff000000u : 0u, 0x1000u, 0u, 0u, 0u, 0u})
        append_little(bytes, value, 4);
    return bytes + data;
}

std::vector<float> over_255(const std::vector<int>& codes) {
    std::vector<float> values;
    for (const int code : codes) values.push_back(static_cast<float>(code) / 255.0f);
    return values;
}

TEST_F(Bitmaps, DdsPlainAndCompressed) {
    const Bytes pixels("\x1e\x14\x0a\xff\x3c\x32\x28\x80\x5a\x50\x46\x00\xdc\xd2\xc8\x40", 16);
    const Image plain = load_image(write("u.dds", make_dds(2, 0x41, Bytes(4, '\0'), 32, pixels)));
    // Alpha does not touch colours, which may stand beside heights.
    EXPECT_EQ(plain.values,
              over_255({10, 20, 30, 255, 40, 50, 60, 128, 70, 80, 90, 0, 200, 210, 220, 64}));
    // BC1: red and blue, and a third of the way between them, in each row.
    const Bytes block("\x00\xf8\x1f\x00\xe4\xe4\xe4\xe4", 8);
    const Image packed = load_image(write("c.dds", make_dds(4, 4, "DXT1", 0, block)));
    EXPECT_EQ(packed.width, 4);
    EXPECT_EQ(packed.channels, 4);
    for (std::size_t y = 0; y < 4; ++y)
        EXPECT_EQ(
            std::vector<float>(packed.values.begin() + static_cast<std::ptrdiff_t>(16 * y),
                               packed.values.begin() + static_cast<std::ptrdiff_t>(16 * y + 16)),
            over_255({255, 0, 0, 255, 0, 0, 255, 255, 170, 0, 85, 255, 85, 0, 170, 255}));
}

TEST_F(Bitmaps, Ktx2IsRefusedByName) {
    const Bytes ktx2("\xabKTX 20\xbb\r\n\x1a\n", 12);
    try {
        load_image(write("a.ktx2", ktx2 + Bytes(100, '\0')), NotFinite::refuse, "material.height");
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(error.found.find("KTX2"), std::string::npos) << error.found;
        EXPECT_EQ(error.key, "material.height");
    }
}

}  // namespace
}  // namespace quadrel::test
