// Values that images carry as codes: every bit comes back, and what is no carrier is refused in a
// line that says why.
#include "quadrel/film/value_bits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

/// An image of channels of codes, by what a code of each is.
using Code = std::function<std::uint32_t(std::size_t i)>;

ComparableImage image_of(int width, int height,
                         const std::vector<std::pair<std::string, Code>>& channels,
                         std::uint32_t most, Storage storage) {
    const Window window{0, 0, width, height};
    ComparableImage image{"shot", {window, window, {}}, {}, {}};
    for (const auto& [name, code] : channels) {
        Plane& plane = image.film.add(
            name, storage == Storage::uint32 ? ChannelType::uint32 : ChannelType::float32);
        for (std::size_t i = 0; i < plane.bits.size(); ++i)
            plane.bits[i] =
                storage == Storage::uint32
                    ? code(i)
                    : testing_films::bits(static_cast<float>(code(i)) / static_cast<float>(most));
        image.stored[name] = storage;
    }
    return image;
}

/// A frame of all kinds of floats, and of an integer.
Film reference() { return testing_films::random_film(3, {0, 0, 17, 13}, {0, 0, 17, 13}); }

Code bits_from(const Plane& plane, int first, int count) {
    return [&plane, first, count](std::size_t i) {
        return plane.bits[i] >> first & ((1u << count) - 1);
    };
}

ComparableImage rgba8(const Plane& plane) {
    return image_of(17, 13,
                    {{"R", bits_from(plane, 0, 8)},
                     {"G", bits_from(plane, 8, 8)},
                     {"B", bits_from(plane, 16, 8)},
                     {"A", bits_from(plane, 24, 8)}},
                    255, Storage::unorm8);
}

/// Written from the description in data/snippets/README.md: low beside high.
ComparableImage rgb8(const Plane& plane, bool with_alpha = false) {
    const auto half = [&plane](std::size_t i) {
        const std::size_t x = i % 34, y = i / 34, from = y * 17 + x % 17;
        return x < 17 ? plane.bits[from] % 65536 : plane.bits[from] / 65536;
    };
    const auto check = [half](std::size_t i) {
        const std::uint32_t sum = half(i) % 256 * 3 + half(i) / 256 * 7;
        return (sum + (i % 34 < 17 ? 90 : 165)) % 256;
    };
    std::vector<std::pair<std::string, Code>> channels = {
        {"R", [half](std::size_t i) { return half(i) % 256; }},
        {"G", [half](std::size_t i) { return half(i) / 256; }},
        {"B", check}};
    if (with_alpha) channels.push_back({"A", [](std::size_t) { return 255u; }});
    return image_of(34, 13, channels, 255, Storage::unorm8);
}

Plane decoded(const ComparableImage& image, const std::string& argument, const Film& film) {
    const CarriedBits carries = parse_carried_bits("--decode", argument);
    const std::vector<BitImage> images = {{carries, image}};
    const ComparableImage result = decode_bits(images, film);
    EXPECT_EQ(result.film.frame, film.frame);
    return *result.film.find(carries.channels[0]);
}

testing::AssertionResult comes_back(const Plane& plane, const Film& film) {
    Film canonical = film;
    canonicalize(canonical);
    if (plane == *canonical.find(plane.name)) return testing::AssertionSuccess();
    return testing::AssertionFailure() << plane.name << " has other bits";
}

TEST(ValueBits, ComeBackFromEveryLayout) {
    const Film film = reference();
    for (const char* name : {"R", "hit.P.X", "hit.steps"}) {
        const Plane& plane = *film.find(name);
        const std::string channel = std::string(":") + name;
        for (const char* layout : {"bits", "rgba8"})
            EXPECT_TRUE(comes_back(decoded(rgba8(plane), layout + channel, film), film));
        for (const bool alpha : {false, true})
            EXPECT_TRUE(comes_back(decoded(rgb8(plane, alpha), "bits" + channel, film), film));
        for (const Storage storage : {Storage::unorm16, Storage::uint32, Storage::float32}) {
            const auto image =
                image_of(17, 13, {{"R", bits_from(plane, 0, 16)}, {"G", bits_from(plane, 16, 16)}},
                         65535, storage);
            EXPECT_TRUE(comes_back(decoded(image, "rg16" + channel, film), film));
            if (storage != Storage::unorm16) continue;
            const auto opaque = image_of(
                17, 13,
                {{"B", [](std::size_t) { return 0; }}, {"A", [](std::size_t) { return 65535; }}},
                65535, storage);
            ComparableImage four = image;
            for (const Plane& plane_of : opaque.film.planes) {
                four.film.planes.push_back(plane_of);
                four.stored[plane_of.name] = storage;
            }
            EXPECT_TRUE(comes_back(decoded(four, "bits" + channel, film), film));
        }
    }
}

/// Ten bits as a file of 16 bits or of halves has them, replicated or rounded.
TEST(ValueBits, ComeBackFromTenBits) {
    const Film film = reference();
    const Plane& plane = *film.find("Z");
    for (const Storage storage : {Storage::unorm16, Storage::half}) {
        ComparableImage image = image_of(17, 13,
                                         {{"R", bits_from(plane, 0, 10)},
                                          {"G", bits_from(plane, 10, 10)},
                                          {"B", bits_from(plane, 20, 10)}},
                                         1023, storage);
        const ComparableImage alpha =
            image_of(17, 13, {{"A", bits_from(plane, 30, 2)}}, 3, storage);
        image.film.planes.push_back(alpha.film.planes[0]);
        image.stored["A"] = storage;
        for (Plane& part : image.film.planes)
            for (std::uint32_t& word : part.bits)
                word = testing_films::bits(storage == Storage::half
                                               ? encode(Encoding::half, std::bit_cast<float>(word))
                                               : std::floor(std::bit_cast<float>(word) * 65535) /
                                                     65535);
        EXPECT_TRUE(comes_back(decoded(image, "rgb10a2:Z", film), film));
        if (storage == Storage::unorm16) {
            EXPECT_TRUE(comes_back(decoded(image, "bits:Z", film), film));
        }
    }
}

TEST(ValueBits, SeveralImagesAndTiles) {
    const Film film = reference();
    const Plane& u = *film.find("uv.U");
    // Two tiles, one above the other.
    const auto of_tiles = [&](int first) {
        return [&film, &u, first](std::size_t i) {
            const Plane& plane = i < 17 * 13 ? u : *film.find("A");
            return plane.bits[i % (17 * 13)] >> first & 255;
        };
    };
    const ComparableImage tiles = image_of(
        17, 26, {{"R", of_tiles(0)}, {"G", of_tiles(8)}, {"B", of_tiles(16)}, {"A", of_tiles(24)}},
        255, Storage::unorm8);
    const auto low = image_of(17, 13, {{"R", bits_from(u, 0, 16)}}, 65535, Storage::unorm16);
    const auto high = image_of(17, 13, {{"R", bits_from(u, 16, 16)}}, 65535, Storage::unorm16);
    const auto decode =
        [&](const std::vector<std::pair<std::string, const ComparableImage*>>& all) {
            std::vector<BitImage> images;
            for (const auto& [text, image] : all)
                images.push_back({parse_carried_bits("--decode", text), *image});
            return decode_bits(images, film).film;
        };
    const Film both = decode({{"bits:uv.U,A", &tiles}});
    EXPECT_TRUE(comes_back(*both.find("uv.U"), film));
    EXPECT_TRUE(comes_back(*both.find("A"), film));
    const Film halves = decode({{"high:uv.U", &high}, {"low:uv.U", &low}});
    EXPECT_TRUE(comes_back(*halves.find("uv.U"), film));
    EXPECT_THROW(decode({{"low:uv.U", &low}}), UsageError);
    EXPECT_THROW(decode({{"low:uv.U", &low}, {"low:uv.U", &low}}), UsageError);
    EXPECT_THROW(decode({{"bits:uv.W,A", &tiles}}), UsageError);
}

/// The message of what decoding throws; empty if it throws nothing.
std::string refusal(const ComparableImage& image, const std::string& argument) {
    try {
        decoded(image, argument, reference());
        return "";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
}

ComparableImage changed(ComparableImage image, const std::function<float(float)>& change) {
    for (const char* name : {"R", "G", "B"})
        for (std::uint32_t& word : image.film.find(name)->bits)
            word = testing_films::bits(change(std::bit_cast<float>(word)));
    return image;
}

TEST(ValueBits, WhatIsNoCarrierIsRefused) {
    const Film film = reference();
    const Plane& plane = *film.find("R");
    const auto says = [](const std::string& message, const char* words) {
        return message.find(words) != std::string::npos
                   ? testing::AssertionSuccess()
                   : testing::AssertionFailure() << "\"" << message << "\" lacks " << words;
    };
    ComparableImage opaque = rgba8(plane);
    std::ranges::fill(opaque.film.find("A")->bits, testing_films::bits(1));
    EXPECT_TRUE(says(refusal(opaque, "bits:R"), "alpha 255 in every pixel"));
    ComparableImage without = rgba8(plane);
    without.film.planes.pop_back();
    EXPECT_TRUE(says(refusal(without, "rgba8:R"), "also A"));
    EXPECT_TRUE(says(refusal(without, "bits:R"), "2 tiles of 17 x 13"));
    ComparableImage gray = without;
    gray.film.planes.resize(1);
    EXPECT_TRUE(says(refusal(gray, "bits:R"), "expected R G B A"));
    EXPECT_TRUE(says(refusal(rgba8(plane), "rg16:R"), "codes of 8 bits"));
    // What a display does to codes; planted: each of them in a carrier that is right otherwise.
    const ComparableImage right = rgb8(plane);
    EXPECT_EQ(refusal(right, "bits:R"), "");
    const auto rounded = [](double v) { return static_cast<float>(std::round(v * 255) / 255); };
    const std::pair<planted::FilmError, std::function<float(float)>> spoils[] = {
        {planted::FilmError::bits_as_srgb, [&](float v) { return rounded(std::pow(v, 1 / 2.2)); }},
        {planted::FilmError::bits_dithered, [&](float v) { return rounded(v * 254.0 / 255); }},
        {planted::FilmError::bits_inverted, [&](float v) { return 1 - v; }}};
    for (const auto& [error, spoil] : spoils)
        EXPECT_TRUE(says(refusal(changed(right, spoil), "rgb8:R"), "the check byte"))
            << static_cast<int>(error);
    const char* const orders[] = {"BGR", "GRB", "RBG", "GBR", "BRG"};
    for (const char* order : orders) {
        ComparableImage other = right;
        for (std::size_t i = 0; i < 3; ++i)
            other.film.find(std::string(1, order[i]))->bits = right.film.planes[i].bits;
        EXPECT_TRUE(says(refusal(other, "rgb8:R"), "the check byte")) << order;
    }
    EXPECT_TRUE(says(refusal(changed(right, [](float v) { return v * 0.999f; }), "rgb8:R"),
                     "a code of 8 bits"));
}

TEST(ValueBits, ArgumentsAreReadStrictly) {
    EXPECT_EQ(parse_carried_bits("-x", "rgba8:hit.U,N.X=a=b.png"),
              (CarriedBits{BitLayout::rgba8, {"hit.U", "N.X"}, "a=b.png"}));
    for (const char* text : {"", "hit.U", "bits:", "bits:a,", "bits:a,,b", "bits:a=", "bit:a"})
        EXPECT_THROW(parse_carried_bits("-x", text), UsageError) << text;
}

}  // namespace
}  // namespace quadrel
