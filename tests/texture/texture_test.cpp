// Formats, mip chains, swizzles, colour spaces, identity of textures.
#include "quadrel/texture/texture.hpp"

#include <algorithm>
#include <bit>

#include "quadrel/error.hpp"
#include "quadrel/num/srgb.hpp"
#include "texture/mip.hpp"
#include "texture/planted.hpp"
#include "texture/support.hpp"
#include "texture/swizzle.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::test {
namespace {

Image make_image(int width, int height, int channels, std::vector<float> values,
                 TexelFormat format = TexelFormat::float32) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.format = format;
    image.values = std::move(values);
    return image;
}

/// An image of 8-bit codes.
Image make_codes(int width, int height, int channels, const std::vector<int>& codes) {
    std::vector<float> values;
    for (const int code : codes) values.push_back(static_cast<float>(code) / 255.0f);
    return make_image(width, height, channels, std::move(values), TexelFormat::unorm8);
}

std::vector<float> level(const Texture& texture, int index, int face = 0) {
    return texture_level(texture, index, face).values;
}

// ---- Formats ------------------------------------------------------------------------------------

using Store = std::function<float(double value, TexelFormat)>;

float store(double value, TexelFormat format) { return store_and_decode(value, 1, format, false); }

testing::AssertionResult decodes_as_specified(const Store& stored) {
    const std::tuple<TexelFormat, int, std::uint32_t> expected[] = {
        {TexelFormat::unorm8, 1, 0x3b808081},     {TexelFormat::unorm8, 127, 0x3efefeff},
        {TexelFormat::unorm8, 128, 0x3f008081},   {TexelFormat::unorm8, 254, 0x3f7efeff},
        {TexelFormat::unorm8, 255, 0x3f800000},   {TexelFormat::unorm16, 1, 0x37800080},
        {TexelFormat::unorm16, 32768, 0x3f000080}};
    for (const auto& [format, code, want] : expected) {
        const auto got = std::bit_cast<std::uint32_t>(
            stored(static_cast<double>(code) / max_code(format), format));
        if (got != want) return testing::AssertionFailure() << code << std::hex << " " << got;
    }
    return testing::AssertionSuccess();
}

TEST(Format, Decode) {
    EXPECT_TRUE(decodes_as_specified(store));
    EXPECT_FALSE(decodes_as_specified([](double value, TexelFormat format) {
        const auto max = static_cast<float>(max_code(format));  // Planted::reciprocal_decode
        return static_cast<float>(encode_unorm(value, 1, max_code(format))) * (1 / max);
    }));
}

using Encode = std::function<int(double)>;

testing::AssertionResult rounds_half_up(const Encode& encode) {
    const std::pair<double, int> expected[] = {{0.5, 128}, {1.0 / 510, 1}, {5.0 / 510, 3},
                                               {-1, 0},    {2, 255},       {0.999, 255}};
    for (const auto& [value, code] : expected) {
        if (encode(value) != code) return testing::AssertionFailure() << value;
    }
    return testing::AssertionSuccess();
}

TEST(Format, Encode) {
    EXPECT_TRUE(rounds_half_up([](double x) { return encode_unorm(x, 1, 255); }));
    EXPECT_FALSE(rounds_half_up([](double x) {  // Planted::truncating_encode
        return static_cast<int>(std::clamp(x, 0.0, 1.0) * 255);
    }));
    EXPECT_EQ(encode_unorm(std::numeric_limits<double>::quiet_NaN(), 1, 255), 0);
}

using Half = std::function<double(double)>;

testing::AssertionResult rounds_to_half(const Half& half) {
    const std::pair<double, double> expected[] = {{0.333251953125, 0.333251953125},
                                                  {65504, 65504},
                                                  {65519, 65504},
                                                  {-2049, -2048},
                                                  {0x1p-24, 0x1p-24},
                                                  {0x1p-25, 0},
                                                  {0x1.8p-25, 0x1p-24},
                                                  {1 + 3 * 0x1p-11, 1 + 0x1p-9},
                                                  {1 + 0x1p-11 + 0x1p-40, 1 + 0x1p-10}};
    for (const auto& [value, want] : expected) {
        if (half(value) != want) return testing::AssertionFailure() << value << " " << half(value);
    }
    if (!std::isinf(half(65520))) return testing::AssertionFailure() << "overflow";
    return testing::AssertionSuccess();
}

TEST(Format, Half) {
    EXPECT_TRUE(rounds_to_half(round_to_half));
    EXPECT_FALSE(rounds_to_half([](double x) {  // Planted::half_towards_zero
        return std::trunc(x * 0x1p10) * 0x1p-10;
    }));
    EXPECT_FALSE(rounds_to_half([](double x) {  // rounded twice, by way of a float
        return round_to_half(static_cast<float>(x));
    }));
}

TEST(Format, Srgb) {
    const std::pair<int, double> expected[] = {{1, 0.0003035269835488375},
                                               {10, 0.003035269835488375},
                                               {11, 0.003346535763899161},
                                               {128, 0.21586050011389926},
                                               {255, 1}};
    for (const auto& [code, linear] : expected) {
        EXPECT_EQ(store(linear, TexelFormat::srgb8), static_cast<float>(linear)) << code;
    }
    for (int code = 0; code < 256; ++code) {
        const double linear = srgb_decode(code / 255.0);
        EXPECT_EQ(encode_srgb8(linear), code);
    }
    for (int i = 0; i <= 10000; ++i) {
        const double linear = i / 10000.0;
        EXPECT_EQ(encode_srgb8(linear), encode_unorm(srgb_encode(linear), 1, 255)) << linear;
    }
    EXPECT_EQ(encode_srgb8(-1), 0);
    EXPECT_EQ(encode_srgb8(2), 255);
    EXPECT_EQ(encode_srgb8(std::numeric_limits<double>::quiet_NaN()), 0);
}

// ---- Mip chains ---------------------------------------------------------------------------------

TEST(Mips, Sizes) {
    const auto sizes = [](int width, int height) {
        const auto texture =
            make_texture(make_image(width, height, 1, std::vector<float>(width * height, 0.25f)));
        std::vector<std::pair<int, int>> result;
        for (int i = 0; i < texture->view().levels; ++i) {
            result.emplace_back(texture->view().width[i], texture->view().height[i]);
            EXPECT_EQ(texture->view().offset[i] % 16, 0);
            for (const float value : level(*texture, i)) EXPECT_EQ(value, 0.25f);
        }
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(texture->view().texels) % 64, 0u);
        return result;
    };
    using Sizes = std::vector<std::pair<int, int>>;
    EXPECT_EQ(sizes(5, 3), (Sizes{{5, 3}, {2, 1}, {1, 1}}));
    EXPECT_EQ(sizes(1, 1), (Sizes{{1, 1}}));
    EXPECT_EQ(sizes(1, 6), (Sizes{{1, 6}, {1, 3}, {1, 1}}));
    EXPECT_EQ(sizes(1023, 7).size(), 10u);
    EXPECT_EQ(sizes(1023, 7)[2], (std::pair{255, 1}));
}

using Rule = std::function<std::vector<float>(const Image&, MipRule)>;

std::vector<float> first_mip(const Image& image, MipRule rule) {
    TextureOptions options;
    options.mip_rule = rule;
    return level(*make_texture(image, options), 1);
}

/// The box rule leaves the last texel of an odd row out, the area rule does not.
testing::AssertionResult reduces_odd_rows(const Rule& reduce) {
    const Image row = make_image(5, 1, 1, {0, 10, 20, 30, 40});
    if (reduce(row, MipRule::box) != std::vector<float>{5, 25}) {
        return testing::AssertionFailure() << "box";
    }
    if (reduce(row, MipRule::area) != std::vector<float>{8, 32}) {
        return testing::AssertionFailure() << "area";
    }
    return testing::AssertionSuccess();
}

TEST(Mips, OddRow) {
    EXPECT_TRUE(reduces_odd_rows(first_mip));
    EXPECT_FALSE(reduces_odd_rows([](const Image& image, MipRule) {
        return first_mip(image, MipRule::area);  // Planted::box_covers_all
    }));
    const Image row = make_image(5, 1, 1, {0, 10, 20, 30, 40});
    TextureOptions options;
    options.mip_rule = MipRule::area;
    EXPECT_EQ(level(*make_texture(row, options), 2), (std::vector<float>{20}));
    options.mip_rule = MipRule::none;
    EXPECT_EQ(make_texture(row, options)->view().levels, 1);
}

TEST(Mips, RulesAgreeOnPowersOfTwo) {
    std::vector<int> codes;
    std::mt19937 random(1);
    for (int i = 0; i < 16 * 8 * 4; ++i) codes.push_back(static_cast<int>(random() % 256));
    const Image image = make_codes(16, 8, 4, codes);
    TextureOptions box, area;
    area.mip_rule = MipRule::area;
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(level(*make_texture(image, box), i), level(*make_texture(image, area), i));
    }
}

using Chain = std::function<std::vector<float>(const Image&)>;

/// The last level of codes is their mean, rounded once, half up; here 0.5 codes below 2: rounding
/// level 1 first would give 2.
testing::AssertionResult levels_are_rounded_once(const Chain& last_level) {
    const Image image = make_codes(4, 4, 1, {0, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0, 0});
    const auto top = last_level(image);  // level 1: 0.5 1 0 0.25, mean 0.4375
    if (top != std::vector<float>{0.0f}) return testing::AssertionFailure() << top[0] * 255;
    return testing::AssertionSuccess();
}

std::vector<float> real_last_level(const Image& image) {
    const auto texture = make_texture(image);
    return level(*texture, texture->view().levels - 1);
}

TEST(Mips, FromUnroundedLevels) {
    EXPECT_TRUE(levels_are_rounded_once(real_last_level));
    EXPECT_FALSE(levels_are_rounded_once([](const Image& image) {  // Planted::mips_of_rounded
        Image level1 = make_image(2, 2, 1, level(*make_texture(image), 1), TexelFormat::unorm8);
        return real_last_level(level1);
    }));
}

/// Halves in sRGB: their decoded values are no halves, and it is these that are averaged. Rounded
/// first, some of many means would be other halves.
testing::AssertionResult averages_decoded_halves(const Chain& last_level) {
    std::mt19937 random(3);
    int differing = 0;
    for (int k = 0; k < 200; ++k) {
        std::vector<float> stored;
        double sum = 0, sum_of_rounded = 0;
        for (int i = 0; i < 4; ++i) {
            stored.push_back(store(static_cast<double>(random() % 4096) / 4096, TexelFormat::half));
            const double decoded = srgb_decode(static_cast<double>(stored.back()));
            sum += decoded;
            sum_of_rounded += double{store(decoded, TexelFormat::half)};
        }
        const float expected = store(sum / 4, TexelFormat::half);
        const auto got = last_level(make_image(2, 2, 1, stored, TexelFormat::half));
        if (got[0] != expected)
            return testing::AssertionFailure() << got[0] << ", expected " << expected;
        differing += store(sum_of_rounded / 4, TexelFormat::half) != expected;
    }
    return differing > 0 ? testing::AssertionSuccess()
                         : testing::AssertionFailure() << "nothing is told apart";
}

TEST(Mips, OfHalvesInSrgbAreMeansOfWhatTheyDecodeTo) {
    TextureOptions srgb;
    srgb.srgb = true;
    EXPECT_TRUE(averages_decoded_halves(
        [&](const Image& image) { return level(*make_texture(image, srgb), 1); }));
    EXPECT_FALSE(averages_decoded_halves([&](const Image& image) {  // Planted::mips_of_rounded
        const auto first = level(*make_texture(image, srgb), 0);
        return level(*make_texture(make_image(2, 2, 1, first, TexelFormat::half)), 1);
    }));
}

/// Not in float32, whose powers are an ulp off here and there.
TEST(Mips, FloatsInSrgbAreDecodedInDouble) {
    TextureOptions srgb;
    srgb.srgb = true;
    int differing = 0;
    for (int k = 1; k < 200; ++k) {
        const float stored = static_cast<float>(k) / 199;
        const Image image = make_image(1, 1, 1, {stored}, TexelFormat::float32);
        const auto expected = static_cast<float>(srgb_decode(static_cast<double>(stored)));
        EXPECT_EQ(level(*make_texture(image, srgb), 0)[0], expected) << stored;
        differing += srgb_decode(stored) != expected;
    }
    EXPECT_GT(differing, 0);
}

TEST(Mips, TiesOfCodesAreExact) {
    for (int code = 0; code < 255; ++code) {
        const auto texture = make_texture(make_codes(2, 1, 1, {code, code + 1}));
        EXPECT_EQ(level(*texture, 1)[0], static_cast<float>(code + 1) / 255.0f) << code;
        TextureOptions complement;
        complement.swizzle = "1-r";
        const auto other = make_texture(make_codes(2, 1, 1, {code, code + 1}), complement);
        EXPECT_EQ(level(*other, 1)[0], static_cast<float>(255 - code) / 255.0f) << code;
    }
}

testing::AssertionResult filters_linear_values(const Chain& last_level) {
    // Midway between black and white is 0.5 in linear light, code 188.
    const auto got = last_level(make_codes(2, 1, 1, {0, 255}));
    if (got[0] == store(0.5, TexelFormat::srgb8) && std::fabs(got[0] - 0.50288646f) < 1e-7f) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << got[0];
}

TEST(Mips, SrgbIsDecodedBeforeFiltering) {
    TextureOptions srgb;
    srgb.srgb = true;
    EXPECT_EQ(make_texture(make_codes(1, 1, 1, {3}), srgb)->format(), TexelFormat::srgb8);
    EXPECT_TRUE(filters_linear_values(
        [&](const Image& image) { return level(*make_texture(image, srgb), 1); }));
    EXPECT_FALSE(filters_linear_values([&](const Image& image) {  // Planted::filter_before_decode
        const auto codes = level(*make_texture(image), 1);
        return level(*make_texture(make_image(1, 1, 1, codes, TexelFormat::unorm8), srgb), 0);
    }));
}

TEST(Mips, AlphaStaysLinear) {
    TextureOptions srgb;
    srgb.srgb = true;
    const auto texture =
        make_texture(make_codes(2, 1, 4, {10, 20, 30, 100, 10, 20, 30, 101}), srgb);
    const auto top = level(*texture, 1);
    EXPECT_EQ(top[0], store(srgb_decode(10 / 255.0), TexelFormat::srgb8));
    EXPECT_EQ(top[3], 101.0f / 255.0f);
    EXPECT_EQ(level(*texture, 0)[3], 100.0f / 255.0f);
}

// ---- Swizzles, flips ----------------------------------------------------------------------------

std::vector<float> swizzled(const Image& image, const std::string& swizzle) {
    TextureOptions options;
    options.swizzle = swizzle;
    return level(*make_texture(image, options), 0);
}

TEST(Swizzle, PicksChannels) {
    const Image rgba = make_image(1, 1, 4, {0.125f, 0.25f, 0.5f, 0.75f});
    using Values = std::vector<float>;
    EXPECT_EQ(swizzled(rgba, ""), rgba.values);
    EXPECT_EQ(swizzled(rgba, "a"), Values{0.75f});
    EXPECT_EQ(swizzled(rgba, alpha_or_first), Values{0.75f});
    EXPECT_EQ(swizzled(make_image(1, 1, 3, {1, 2, 3}), alpha_or_first), Values{1});
    EXPECT_EQ(swizzled(make_image(1, 1, 2, {1, 2}), alpha_or_first), Values{1}) << "no alpha";
    EXPECT_EQ(swizzled(rgba, "1-a"), Values{0.25f});
    EXPECT_EQ(swizzled(rgba, "rgb1"), (Values{0.125f, 0.25f, 0.5f, 1}));
    EXPECT_EQ(swizzled(rgba, "rgb"), (Values{0.125f, 0.25f, 0.5f, 1}));
    EXPECT_EQ(swizzled(rgba, "gba1"), (Values{0.25f, 0.5f, 0.75f, 1}));
    EXPECT_EQ(swizzled(rgba, "r 1-g, 0 1"), (Values{0.125f, 0.75f, 0, 1}));
    EXPECT_EQ(swizzled(rgba, "11-r"), (Values{1, 0.875f}));
    EXPECT_EQ(swizzled(make_image(1, 1, 3, {1, 2, 3}), ""), (Values{1, 2, 3, 1}));
}

TEST(Swizzle, LuminanceIsGrey) {
    Image grey = make_image(1, 1, 2, {0.25f, 0.5f});
    grey.luminance = true;
    using Values = std::vector<float>;
    EXPECT_EQ(swizzled(grey, "rgba"), (Values{0.25f, 0.25f, 0.25f, 0.5f}));
    EXPECT_EQ(swizzled(grey, "a"), Values{0.5f});
    EXPECT_EQ(swizzled(grey, ""), grey.values);
}

TEST(Swizzle, RefusesWhatIsNotThere) {
    Image red = make_image(1, 1, 1, {0.5f});
    red.file = "red.exr";
    for (const char* wrong : {"x", "rgbar", "2", "1-", "1-1", " ", "g", "a", "R"}) {
        try {
            swizzled(red, wrong);
            ADD_FAILURE() << wrong;
        } catch (const InputError& error) {
            EXPECT_EQ(error.file, "red.exr");
            EXPECT_NE(error.found.find(wrong), std::string::npos);
        }
    }
}

using Flip = std::function<std::vector<float>(const Image&, const TextureOptions&)>;

testing::AssertionResult flips_rows(const Flip& make) {
    TextureOptions options;
    options.flip_v = true;
    const auto got = make(make_image(1, 3, 1, {1, 2, 3}), options);
    return got == std::vector<float>{3, 2, 1} ? testing::AssertionSuccess()
                                              : testing::AssertionFailure();
}

TEST(Texture, FlipV) {
    EXPECT_TRUE(flips_rows([](const Image& image, const TextureOptions& options) {
        return level(*make_texture(image, options), 0);
    }));
    EXPECT_FALSE(flips_rows([](const Image& image, TextureOptions options) {
        options.flip_v = false;  // Planted::flip_forgotten
        return level(*make_texture(image, options), 0);
    }));
}

// ---- Identity, limits, cubes --------------------------------------------------------------------

TEST(Texture, IdChangesWithEveryOption) {
    const Image image = make_codes(2, 1, 1, {1, 2});
    std::vector<std::string> ids = {make_texture(image)->id()};
    const auto add = [&](const Image& of, auto&& change) {
        TextureOptions options;
        change(options);
        ids.push_back(make_texture(of, options)->id());
    };
    add(image, [](TextureOptions& o) { o.swizzle = "r"; });
    add(image, [](TextureOptions& o) { o.srgb = true; });
    add(image, [](TextureOptions& o) { o.format = TexelFormat::half; });
    add(image, [](TextureOptions& o) { o.mip_rule = MipRule::area; });
    add(image, [](TextureOptions& o) { o.flip_v = true; });
    add(make_codes(2, 1, 1, {1, 3}), [](TextureOptions&) {});
    add(make_codes(1, 2, 1, {1, 2}), [](TextureOptions&) {});
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
    EXPECT_EQ(make_texture(image)->id(), make_texture(image)->id());
}

TEST(Texture, RefusesAbsurdSizes) {
    for (const auto& [width, height] : {std::pair{0, 1}, {65537, 1}, {65536, 65536}}) {
        EXPECT_THROW(make_texture(make_image(width, height, 1, {})), InputError);
    }
}

TEST(Texture, CubeFacesKeepTheirOrder) {
    std::array<Image, 6> faces;
    for (int i = 0; i < 6; ++i) {
        faces[i] = make_image(2, 2, 3, std::vector<float>(12, static_cast<float>(i)));
    }
    const auto cube = make_cube_texture(faces);
    EXPECT_EQ(cube->view().faces, 6);
    EXPECT_EQ(cube->view().levels, 2);
    for (int i = 0; i < 6; ++i) {
        for (int l = 0; l < 2; ++l) EXPECT_EQ(level(*cube, l, i)[0], i);
    }
    faces[3] = make_image(1, 2, 3, std::vector<float>(6));
    EXPECT_THROW(make_cube_texture(faces), InputError);
    faces[3] = make_image(4, 4, 3, std::vector<float>(48));
    EXPECT_THROW(make_cube_texture(faces), InputError);
}

}  // namespace
}  // namespace quadrel::test
