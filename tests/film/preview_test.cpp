#include "quadrel/film/preview.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/heatmap.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using Encoder = std::function<std::uint8_t(float)>;

/// IEC 61966-2-1 as the standard has it; a test may use the C library's pow.
double standard_srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

AssertionResult follows_the_standard(const Encoder& encode) {
    for (int i = 0; i <= 100000; ++i) {
        const float linear = static_cast<float>(i) / 100000.0f;
        const double exact = 255 * standard_srgb(linear);
        if (std::abs(encode(linear) - exact) > 0.5 + 1e-3)
            return AssertionFailure() << linear << " gives " << int{encode(linear)};
    }
    return AssertionSuccess();
}

TEST(SrgbCode, FollowsTheStandard) {
    EXPECT_TRUE(follows_the_standard(srgb_code));
    EXPECT_FALSE(follows_the_standard([](float linear) {
        return static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / 2.2)));
    })) << "planted: srgb_gamma_22";
    EXPECT_EQ(srgb_code(-HUGE_VALF), 0);
    EXPECT_EQ(srgb_code(HUGE_VALF), 255);
    EXPECT_EQ(srgb_code(NAN), 0);
}

TEST(SrgbCode, DecodedCodesComeBack) {
    for (int code = 0; code < 256; ++code) {
        const double s = code / 255.0;
        const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        EXPECT_EQ(srgb_code(static_cast<float>(linear)), code);
    }
}

Picture read_png(const std::filesystem::path& file) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0);
    image.format = PNG_FORMAT_RGB;
    Picture picture(static_cast<int>(image.width), static_cast<int>(image.height), 0);
    EXPECT_NE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr), 0);
    return picture;
}

TEST(Png, RoundTripsAndIsDeterministic) {
    const testing_films::TemporaryFolder folder;
    const Picture picture = preview(testing_films::smooth_film(1));
    write_png(folder / "a.png", picture);
    write_png(folder / "b.png", picture);
    EXPECT_EQ(read_png(folder / "a.png").rgb, picture.rgb);
    EXPECT_EQ(testing_films::file_bytes(folder / "a.png"),
              testing_films::file_bytes(folder / "b.png"));
    EXPECT_THROW(write_png("/nonexistent/a.png", picture), OutputError);
}

TEST(Preview, NanIsMagenta) {
    Film film = testing_films::smooth_film(2);
    film.planes[1].bits[3] = canonical_nan;
    const Picture picture = preview(film);
    EXPECT_EQ((std::vector<std::uint8_t>(picture.rgb.begin() + 9, picture.rgb.begin() + 12)),
              (std::vector<std::uint8_t>{255, 0, 255}));
}

TEST(Preview, OneChannelIsSpreadOverTheGrays) {
    Film film{{0, 0, 4, 1}, {0, 0, 4, 1}, {}};
    Plane& plane = film.add("Z", ChannelType::float32);
    plane.bits = {0x3f800000, 0x40000000, 0x40400000, 0x7f800000};  // 1 2 3 inf
    const Picture picture = preview(film);
    EXPECT_EQ(picture.rgb,
              (std::vector<std::uint8_t>{0, 0, 0, 128, 128, 128, 255, 255, 255, 255, 255, 255}));
    film.planes[0].bits.assign(4, canonical_nan);
    EXPECT_EQ(preview(film).rgb[0], 255);
}

TEST(Heatmap, BlackWhereEqualAndHotterWhereWorse) {
    const Film a = testing_films::smooth_film(3);
    Film b = a;
    const auto only_panel = [](const Film& reference, const Film& test) {
        const std::vector<HeatPanel> panels = heat_panels(reference, test);
        EXPECT_EQ(panels.size(), 1u);
        EXPECT_EQ(panels[0].channels, (std::vector<std::string>{"R", "G", "B"}));
        return panels[0].picture;
    };
    const Picture none = only_panel(a, b);
    EXPECT_TRUE(std::all_of(none.rgb.begin(), none.rgb.end(), [](auto v) { return v == 0; }));
    b.planes[0].bits[0] += 1;
    b.planes[0].bits[1] = std::bit_cast<std::uint32_t>(5.0f);
    b.planes[0].bits[2] = canonical_nan;
    const Picture some = only_panel(a, b);
    const auto heat = [&](std::size_t i) {
        return some.rgb[3 * i] + some.rgb[3 * i + 1] + some.rgb[3 * i + 2];
    };
    EXPECT_GT(heat(0), 0);
    EXPECT_GT(heat(1), heat(0));
    EXPECT_EQ(some.rgb[6], 255);
    EXPECT_EQ(some.rgb[7], 0);
    Film moved = testing_films::smooth_film(3, {0, 0, 15, 9});
    EXPECT_THROW(heatmap(a, moved), UsageError);
}

TEST(ContactSheet, HoldsEveryPicture) {
    std::vector<SheetEntry> entries;
    for (int i = 0; i < 5; ++i)
        entries.push_back({"row " + std::to_string(i),
                           Picture(30 + i, 20, static_cast<std::uint8_t>(50 + 40 * i))});
    const Picture sheet = contact_sheet(entries, 3);
    for (const SheetEntry& entry : entries)
        EXPECT_GE(std::count(sheet.rgb.begin(), sheet.rgb.end(), entry.picture.rgb[0]),
                  static_cast<std::ptrdiff_t>(entry.picture.rgb.size()));
    EXPECT_EQ(sheet.width, 3 * (34 + 4) + 4);
    EXPECT_EQ(contact_sheet({}, 3).rgb.size() % 3, 0u);
}

/// Pixels of letters.
std::ptrdiff_t ink_of(const std::string& label) {
    const std::vector<SheetEntry> entry = {{label, Picture(20, 20, 0)}};
    const Picture sheet = contact_sheet(entry, 1);
    return std::count_if(sheet.rgb.begin(), sheet.rgb.end(), [](auto v) { return v > 100; });
}

/// Where a label is longer than its picture is wide, the rest is below.
TEST(ContactSheet, ShowsWholeLabels) {
    const std::ptrdiff_t letter = ink_of("x");
    ASSERT_GT(letter, 0);
    for (const std::size_t length : {3u, 16u, 17u, 80u})
        EXPECT_EQ(ink_of(std::string(length, 'x')), static_cast<std::ptrdiff_t>(length) * letter);
    EXPECT_EQ(ink_of("xxxxx xxxxxxxxxxxxxxxxxxxxxxxxxxx"), 32 * letter);
}

}  // namespace
}  // namespace quadrel
