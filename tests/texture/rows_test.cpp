// Levels are made by rows; each texel is what the rules say of it alone.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <random>

#include "quadrel/num/srgb.hpp"
#include "quadrel/texture/texture.hpp"
#include "texture/planted.hpp"
#include "texture/swizzle.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::test {
namespace {

/// An image and what its texture is to be.
struct Case {
    Image image;
    TextureOptions options;
};

/// A level as its definition has it, texel by texel, in multiples of `unit`.
struct Level {
    int width, height, channels;
    std::vector<double> values;
    double at(int x, int y, int c) const { return values[(y * width + x) * channels + c]; }
};

Level source_level(const Case& of, std::vector<double>& unit) {
    const Image& image = of.image;
    const auto entries = resolve_swizzle(of.options.swizzle, image, "");
    const int codes = max_code(image.format), channels = static_cast<int>(entries.size());
    Level level{image.width, image.height, channels, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (const SwizzleEntry& entry : entries) {
                const bool decoded = of.options.srgb && entry.source >= 0 && entry.source < 3;
                const double one = codes == 0 || decoded ? 1 : codes;
                if (unit.size() < entries.size()) unit.push_back(one);
                const int row = of.options.flip_v ? image.height - 1 - y : y;
                const int index = (row * image.width + x) * image.channels + entry.source;
                double value = entry.constant * one;
                if (entry.source >= 0) {
                    value = image.values[index];
                    if (codes != 0) value = std::floor(value * codes + 0.5);
                    if (decoded) value = srgb_decode(codes != 0 ? value / codes : value);
                    if (entry.complement) value = one - value;
                }
                level.values.push_back(value);
            }
    return level;
}

double box_mean(const Level& l, int x, int y, int c) {
    const int x0 = std::min(2 * x, l.width - 1), x1 = std::min(2 * x + 1, l.width - 1);
    const int y0 = std::min(2 * y, l.height - 1), y1 = std::min(2 * y + 1, l.height - 1);
    return ((l.at(x0, y0, c) + l.at(x1, y0, c)) + (l.at(x0, y1, c) + l.at(x1, y1, c))) / 4;
}

/// How much of texel `i` of `from` lies in texel `j` of `to`, in units of 1 / (from * to).
double overlap(int i, int from, int j, int to) {
    return std::max(0, std::min((i + 1) * to, (j + 1) * from) - std::max(i * to, j * from));
}

double area_mean(const Level& l, int width, int height, int x, int y, int c) {
    double sum = 0;
    for (int j = 0; j < l.height; ++j) {
        double row = 0;
        for (int i = 0; i < l.width; ++i) row += overlap(i, l.width, x, width) * l.at(i, j, c);
        sum += overlap(j, l.height, y, height) * row;
    }
    return sum / (static_cast<double>(l.width) * l.height);
}

Level next_level(const Level& from, MipRule rule) {
    Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), from.channels, {}};
    for (int y = 0; y < to.height; ++y)
        for (int x = 0; x < to.width; ++x)
            for (int c = 0; c < to.channels; ++c)
                to.values.push_back(rule == MipRule::box
                                        ? box_mean(from, x, y, c)
                                        : area_mean(from, to.width, to.height, x, y, c));
    return to;
}

std::vector<float> stored(const Level& level, const std::vector<double>& unit, TexelFormat format) {
    std::vector<float> texels;
    for (std::size_t i = 0; i < level.values.size(); ++i) {
        const std::size_t c = i % static_cast<std::size_t>(level.channels);
        texels.push_back(store_and_decode(level.values[i], unit[c], format, c == 3));
    }
    return texels;
}

bool equal_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    });
}

using Make = std::function<std::shared_ptr<const Texture>(const Case&)>;

testing::AssertionResult follows_the_rules(const Case& of, const Make& make) {
    const auto texture = make(of);
    std::vector<double> unit;
    Level level = source_level(of, unit);
    for (int i = 0; i < texture->view().levels; ++i) {
        if (i > 0) level = next_level(level, of.options.mip_rule);
        const Image made = texture_level(*texture, i);
        if (made.width != level.width || made.height != level.height ||
            !equal_bits(made.values, stored(level, unit, texture->format())))
            return testing::AssertionFailure()
                   << of.image.width << "x" << of.image.height << " level " << i << " of "
                   << format_name(of.image.format) << " as " << format_name(texture->format())
                   << (of.options.srgb ? " srgb" : "") << (of.options.flip_v ? " flipped" : "")
                   << " swizzle \"" << of.options.swizzle << "\"";
    }
    return testing::AssertionSuccess();
}

Image random_image(int width, int height, int channels, TexelFormat format, std::mt19937& random) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.format = format;
    const int codes = max_code(format);
    for (int i = 0; i < width * height * channels; ++i) {
        const auto any = static_cast<float>(random() % 65536);
        image.values.push_back(codes == 0     ? any / 40000.0f - 0.2f
                               : codes == 255 ? std::floor(any / 256) / 255.0f
                                              : any / 65535.0f);
    }
    return image;
}

/// Every kind of source, swizzle, format and rule; sizes with odd rows, single rows and columns,
/// and one of several bands of rows.
std::vector<Case> all_cases() {
    std::mt19937 random(1);
    std::vector<Case> cases;
    const std::pair<int, int> sizes[] = {{1, 1}, {7, 1}, {1, 6}, {2, 2}, {13, 11}, {16, 8}};
    for (const TexelFormat source :
         {TexelFormat::unorm8, TexelFormat::unorm16, TexelFormat::float32})
        for (const char* swizzle : {"", "1-r", "rg", "rgb1", "a1-b0r"})
            for (const MipRule rule : {MipRule::box, MipRule::area, MipRule::none})
                for (const auto& [width, height] : sizes) {
                    Case next;
                    next.image = random_image(width, height, 4, source, random);
                    next.options.swizzle = swizzle;
                    next.options.mip_rule = rule;
                    // Tables of 16 bits take long.
                    next.options.srgb = source != TexelFormat::unorm16 && random() % 3 == 0;
                    next.options.flip_v = random() % 2 == 0;
                    if (random() % 4 != 0)
                        next.options.format = static_cast<TexelFormat>(random() % 5);
                    cases.push_back(next);
                }
    cases.push_back({random_image(300, 259, 4, TexelFormat::unorm8, random), {}});
    return cases;
}

TEST(Rows, FollowTheRules) {
    const auto real = [](const Case& of) { return make_texture(of.image, of.options); };
    for (const Case& of : all_cases()) ASSERT_TRUE(follows_the_rules(of, real));
}

TEST(Rows, TheCheckSeesErrors) {
    std::mt19937 random(2);
    const Case odd{random_image(6, 7, 1, TexelFormat::float32, random), {}};
    const auto planted = [&](const std::function<void(Case&)>& change) {
        return follows_the_rules(odd, [&](Case of) {
            change(of);
            return make_texture(of.image, of.options);
        });
    };
    EXPECT_TRUE(planted([](Case&) {}));
    EXPECT_FALSE(planted([](Case& of) {  // Planted::odd_row_lost: not stored
        std::fill(of.image.values.end() - 6, of.image.values.end(), 0.0f);
    }));
    EXPECT_FALSE(planted([](Case& of) {  // Planted::rows_swapped
        std::rotate(of.image.values.begin(), of.image.values.begin() + 6,
                    of.image.values.begin() + 12);
    }));
    EXPECT_FALSE(planted([](Case& of) { of.options.mip_rule = MipRule::area; }));
}

/// By the definition: the nearest multiple of what the last bit is worth.
double half_by_definition(double x) {
    if (!std::isfinite(x) || x == 0) return x;
    const double quantum = std::ldexp(1.0, std::max(std::ilogb(x), -14) - 10);
    const double rounded = std::nearbyint(x / quantum) * quantum;
    return std::fabs(rounded) <= 65504 ? rounded : std::copysign(INFINITY, x);
}

testing::AssertionResult rounds_everywhere(const std::function<double(double)>& half) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 200000; ++i) {
        // Of any magnitude; every other one a tie or next to one.
        const double any = std::bit_cast<double>(random());
        const double near = std::ldexp(static_cast<double>(random() % 4096) + 0.5 * (i % 3),
                                       static_cast<int>(random() % 36) - 30);
        const double x = i % 2 == 0 ? any : std::nextafter(near, i % 5 < 2 ? near : i % 5 - 3.0);
        const double got = half(x), want = half_by_definition(x);
        if (std::isnan(x) ? !std::isnan(got)
                          : std::bit_cast<std::uint64_t>(got) != std::bit_cast<std::uint64_t>(want))
            return testing::AssertionFailure() << x << " gives " << got << ", not " << want;
    }
    return testing::AssertionSuccess();
}

TEST(Format, HalvesByTheDefinition) {
    EXPECT_TRUE(rounds_everywhere(round_to_half));
    EXPECT_FALSE(rounds_everywhere([](double x) { return round_to_half(static_cast<float>(x)); }));
}

/// At, above and below every value at which one code gives way to the next.
testing::AssertionResult changes_at_thresholds(const std::function<int(double)>& encode) {
    for (int code = 0; code < 255; ++code) {
        const double threshold = srgb_decode((code + 0.5) / 255);
        const double below = std::nextafter(threshold, 0.0);
        if (encode(below) != code || encode(threshold) != code + 1)
            return testing::AssertionFailure() << code;
    }
    return testing::AssertionSuccess();
}

TEST(Format, SrgbCodesChangeAtTheirThresholds) {
    EXPECT_TRUE(changes_at_thresholds(encode_srgb8));
    EXPECT_FALSE(changes_at_thresholds(
        [](double linear) { return encode_srgb8(static_cast<float>(linear)); }));
    EXPECT_EQ(encode_srgb8(INFINITY), 255);
    EXPECT_EQ(encode_srgb8(-INFINITY), 0);
    EXPECT_EQ(encode_srgb8(1e-300), 0);
}

}  // namespace
}  // namespace quadrel::test
