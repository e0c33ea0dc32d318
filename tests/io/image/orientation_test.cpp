// Pictures that files store turned or mirrored come out upright: Radiance by its resolution line,
// TIFF and Exif by their orientation.
#include <cstring>
#include <functional>

#include "io/image/image_folder.hpp"
#include "io/image/orient.hpp"
#include "quadrel/error.hpp"
#include "quadrel/texture/image.hpp"
#include "texture/planted.hpp"

namespace quadrel::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using Load = std::function<Image(const std::filesystem::path&)>;

constexpr int width = 3, height = 2;
/// The picture as it is to be seen.
constexpr int picture[height][width] = {{10, 20, 30}, {40, 50, 60}};

Image plain_load(const std::filesystem::path& file) { return load_image(file); }

/// The stored values of an orientation, by the definition in TIFF 6.0: where the 0th row and the
/// 0th column lie.
Bytes stored(int orientation) {
    const bool columns = orientation >= 5;
    const bool row_far =
        orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    const bool far = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    Bytes bytes;
    const int rows = columns ? width : height, length = columns ? height : width;
    for (int r = 0; r < rows; ++r)
        for (int i = 0; i < length; ++i) {
            const int major = row_far ? rows - 1 - r : r, minor = far ? length - 1 - i : i;
            bytes += static_cast<char>(columns ? picture[minor][major] : picture[major][minor]);
        }
    return bytes;
}

/// The resolution lines of Radiance in the order of these orientations.
constexpr const char* lines[] = {"-Y 2 +X 3", "-Y 2 -X 3", "+Y 2 -X 3", "+Y 2 +X 3",
                                 "+X 3 -Y 2", "-X 3 -Y 2", "-X 3 +Y 2", "+X 3 +Y 2"};

Bytes radiance(int orientation) {
    Bytes bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + Bytes(lines[orientation - 1]) + "\n";
    for (const char value : stored(orientation)) bytes += Bytes(3, value) + '\x80';
    return bytes;
}

AssertionResult is_upright(const Image& image, float unit) {
    if (image.width != width || image.height != height)
        return AssertionFailure() << image.width << "x" << image.height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float value =
                image.values[static_cast<std::size_t>((y * width + x) * image.channels)];
            if (value != static_cast<float>(picture[y][x]) / unit)
                return AssertionFailure() << "column " << x << ", row " << y << ": " << value;
        }
    return AssertionSuccess();
}

class Orientations : public ImageFolder {
  protected:
    AssertionResult all_are_upright(const Load& load) {
        for (int orientation = 1; orientation <= 8; ++orientation) {
            const auto hdr = is_upright(load(write("a.hdr", radiance(orientation))), 256);
            if (!hdr) return AssertionFailure() << lines[orientation - 1] << ": " << hdr.message();
            const bool columns = orientation >= 5;
            const Bytes tiff = make_tiff(columns ? height : width, columns ? width : height,
                                         stored(orientation), orientation);
            const auto tif = is_upright(load(write("a.tif", tiff)), 255);
            if (!tif) return AssertionFailure() << "TIFF " << orientation << ": " << tif.message();
        }
        return AssertionSuccess();
    }
};

/// An image's values as orient() takes them.
void orient(Image& image, int orientation) {
    QuadrelOiioInfo info{image.width, image.height, image.channels, quadrel_oiio_float, 0, 1};
    std::vector<unsigned char> bytes(image.values.size() * sizeof(float));
    std::memcpy(bytes.data(), image.values.data(), bytes.size());
    quadrel::orient(bytes, info, orientation);
    std::memcpy(image.values.data(), bytes.data(), bytes.size());
    image.width = info.width;
    image.height = info.height;
}

/// What a defective reader makes of a picture that was read rightly.
Image reorient(Image image, const std::filesystem::path& file, Planted planted) {
    const int orientation = radiance_orientation(file.string()).value_or(1);
    if (planted == Planted::turns_swapped && (orientation == 6 || orientation == 8))
        orient(image, 3);
    // 6 and 8 undo each other; the others undo themselves.
    if (planted == Planted::orientation_ignored)
        orient(image, orientation == 6 ? 8 : orientation == 8 ? 6 : orientation);
    return image;
}

TEST_F(Orientations, RadianceAndTiffComeOutUpright) {
    EXPECT_TRUE(all_are_upright(plain_load));
    for (const Planted planted : {Planted::turns_swapped, Planted::orientation_ignored})
        EXPECT_FALSE(all_are_upright([planted](const std::filesystem::path& file) {
            return reorient(load_image(file), file, planted);
        }));
}

TEST_F(Orientations, ExifOfAJpegIsFollowed) {
    const Bytes jpeg(reinterpret_cast<const char*>(noise_jpeg), sizeof noise_jpeg);
    const Image plain = load_image(write("plain.jpg", jpeg));
    for (int orientation = 1; orientation <= 8; ++orientation) {
        Bytes exif("Exif\0\0II*\0\x08\0\0\0\x01\0", 16);
        append_little(exif, 274, 2);
        append_little(exif, 3, 2);  // SHORT
        append_little(exif, 1, 4);
        append_little(exif, static_cast<std::uint32_t>(orientation), 4);
        append_little(exif, 0, 4);
        Bytes marker("\xff\xe1", 2);
        append_big(marker, static_cast<std::uint32_t>(exif.size() + 2), 2);
        const Bytes turned = jpeg.substr(0, 2) + marker + exif + jpeg.substr(2);
        Image expected = plain;
        orient(expected, orientation);
        const Image read = load_image(write("turned.jpg", turned));
        EXPECT_EQ(read.values, expected.values) << orientation;
        EXPECT_EQ(read.values == plain.values, orientation == 1) << orientation;
    }
}

/// 2 x 2 pixels of luminance and colour differences, not sub-sampled.
Bytes make_ycbcr_tiff(int orientation) {
    constexpr std::uint32_t entries = 11, list = 8 + 2 + 12 * entries + 4;
    Bytes tiff("II*\0\x08\0\0\0", 8);
    append_little(tiff, entries, 2);
    const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t count,
                           std::uint32_t value) {
        append_little(tiff, tag, 2);
        append_little(tiff, type, 2);
        append_little(tiff, count, 4);
        append_little(tiff, value, 4);
    };
    constexpr std::uint32_t short_type = 3, long_type = 4;
    entry(256, long_type, 1, 2);
    entry(257, long_type, 1, 2);
    entry(258, short_type, 3, list);
    entry(259, short_type, 1, 1);
    entry(262, short_type, 1, 6);  // YCbCr
    entry(273, long_type, 1, list + 6);
    entry(274, short_type, 1, static_cast<std::uint32_t>(orientation));
    entry(277, short_type, 1, 3);
    entry(278, long_type, 1, 2);
    entry(279, long_type, 1, 12);
    entry(530, short_type, 2, 0x10001);  // no sub-sampling
    append_little(tiff, 0, 4);
    for (int c = 0; c < 3; ++c) append_little(tiff, 8, 2);
    return tiff + Bytes("\x10\x80\x80\x20\x80\x80\x30\x80\x80\x40\x80\x80", 12);
}

TEST_F(Orientations, WhatLibtiffTurnsInPartIsRefusedByName) {
    EXPECT_EQ(load_image(write("1.tif", make_ycbcr_tiff(1))).width, 2);
    try {
        load_image(write("3.tif", make_ycbcr_tiff(3)));
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(error.found.find("YCbCr"), std::string::npos) << error.found;
    }
}

TEST_F(Orientations, AResolutionLineThatIsNoneIsRefused) {
    EXPECT_THROW(load_image(write("a.hdr", "#?RADIANCE\n\n-Z 2 +X 3\n" + Bytes(24, '\x80'))),
                 InputError);
}

}  // namespace
}  // namespace quadrel::test
