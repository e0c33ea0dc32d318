// Images made comparable: files of engines, flips, channel names, and encodings of both sides.
#include "quadrel/film/comparable.hpp"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/compare.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::bits;
using testing_films::TemporaryFolder;
using Flip = std::function<void(Film&)>;
using Map = std::function<void(ComparableImage&, std::span<const ChannelMapping>)>;

ComparableImage as_comparable(Film film, Storage storage = Storage::float32) {
    ComparableImage image{"memory", std::move(film), {}, {}};
    for (const Plane& plane : image.film.planes) image.stored[plane.name] = storage;
    return image;
}

/// Pixel (x, y) of the frame goes to (x, bottom - y), whatever the window; twice is nothing.
AssertionResult mirrors(const Flip& flip) {
    const Film film = testing_films::random_film(8, {0, 0, 17, 13}, {3, 2, 12, 9});
    Film flipped = film;
    flip(flipped);
    for (int y = film.window.y0; y < film.window.y1; ++y)
        for (int x = film.window.x0; x < film.window.x1; ++x) {
            const int mirrored = film.frame.y0 + film.frame.y1 - 1 - y;
            if (mirrored < flipped.window.y0 || mirrored >= flipped.window.y1)
                return AssertionFailure() << "row " << mirrored << " is not in the window";
            for (std::size_t p = 0; p < film.planes.size(); ++p)
                if (flipped.planes[p].bits[flipped.index(x, mirrored)] !=
                    film.planes[p].bits[film.index(x, y)])
                    return AssertionFailure() << x << "," << y;
        }
    flip(flipped);
    if (flipped != film) return AssertionFailure() << "twice is another film";
    return AssertionSuccess();
}

TEST(Comparable, FlipMirrorsTheFrame) {
    EXPECT_TRUE(mirrors(flip_y));
    EXPECT_FALSE(mirrors([](Film& film) {  // flip_rows_only
        const Window window = film.window;
        flip_y(film);
        film.window = window;
    }));
}

AssertionResult swaps(const Map& map) {
    ComparableImage image = as_comparable(testing_films::smooth_film(1));
    const Film before = image.film;
    const ChannelMapping swap[] = {{"R", "B"}, {"B", "R"}};
    map(image, swap);
    if (image.film.find("R")->bits != before.find("B")->bits ||
        image.film.find("B")->bits != before.find("R")->bits ||
        image.film.find("G")->bits != before.find("G")->bits)
        return AssertionFailure() << "channels are not swapped";
    return AssertionSuccess();
}

TEST(Comparable, ChannelsAreMappedAtOnce) {
    EXPECT_TRUE(swaps(map_channels));
    EXPECT_FALSE(swaps([](ComparableImage& image, std::span<const ChannelMapping> mappings) {
        for (const ChannelMapping& one : mappings)  // map_one_by_one
            image.film.planes[one.reference == "R" ? 0 : 2].bits = image.film.find(one.test)->bits;
    }));
}

TEST(Comparable, GroupsAreMappedAndConflictsRefused) {
    Film film{{0, 0, 2, 2}, {0, 0, 2, 2}, {}};
    for (const char* name : {"gbuffer.normal.X", "gbuffer.normal.Y", "R"})
        film.add(name, ChannelType::float32);
    ComparableImage image = as_comparable(film);
    const ChannelMapping group[] = {{"N", "gbuffer.normal"}};
    map_channels(image, group);
    EXPECT_NE(image.film.find("N.X"), nullptr);
    EXPECT_NE(image.film.find("N.Y"), nullptr);
    EXPECT_EQ(image.film.find("gbuffer.normal.X"), nullptr);
    EXPECT_EQ(image.stored.size(), 3u);
    const ChannelMapping missing[] = {{"N", "normals"}};
    EXPECT_THROW(map_channels(image, missing), UsageError);
    const ChannelMapping twice[] = {{"G", "R"}, {"G", "N.X"}};
    EXPECT_THROW(map_channels(image, twice), UsageError);
}

/// A film whose R, G, B go over [-0.1, 1.1], as an 8-bit PNG of correctly rounded sRGB codes.
Film ramp() {
    Film film{{0, 0, 64, 8}, {0, 0, 64, 8}, {}};
    float value = -0.1f;
    for (const char* name : {"R", "G", "B"})
        for (std::uint32_t& one : film.add(name, ChannelType::float32).bits)
            one = bits(value += 1.2f / (3 * 512));
    return film;
}

TEST(Comparable, ACorrectlyRoundedPngPassesWithoutTolerance) {
    const TemporaryFolder folder;
    const Film film = ramp();
    Picture picture = preview(film);
    write_png(folder / "port.png", picture);
    ComparableImage reference = as_comparable(film);
    ComparableImage test = read_comparable(folder / "port.png");
    EXPECT_EQ(test.stored.at("R"), Storage::unorm8);
    EXPECT_FALSE(compare(reference.film, test.film).equal());
    CompareRules rules;
    rules.encodings = encode_both(reference, test, Encoding::srgb8);
    EXPECT_EQ(rules.encoding_of("G"), Encoding::srgb8);
    EXPECT_TRUE(compare(reference.film, test.film, rules).equal());
    picture.rgb[100] = static_cast<std::uint8_t>(picture.rgb[100] ^ 1);
    write_png(folder / "off.png", picture);
    const CompareReport off =
        compare(reference.film, read_comparable(folder / "off.png").film, rules);
    EXPECT_FALSE(off.equal());
    EXPECT_EQ(off.channels[1].max_ulp, 1u) << "one code";
    rules.all.ulp = 1;
    EXPECT_TRUE(compare(reference.film, read_comparable(folder / "off.png").film, rules).equal());
}

TEST(Comparable, EncodingKeepsWhatItIsNotFor) {
    Film film = ramp();
    film.add("A", ChannelType::float32, bits(0.25f));
    film.add("Z", ChannelType::float32, bits(5.0f));
    film.add("id.object", ChannelType::uint32, 3);
    ComparableImage reference = as_comparable(film), test = reference;
    test.film.planes[4].bits[0] = bits(6.0f);
    CompareRules rules;
    rules.encodings = encode_both(reference, test, Encoding::srgb8);
    EXPECT_EQ(rules.encoding_of("A"), Encoding::unorm8) << "alpha is linear";
    EXPECT_EQ(code_of(test.film.find("A")->as_float(0)), 64);
    EXPECT_EQ(rules.encoding_of("Z"), Encoding::none);
    EXPECT_FALSE(compare(reference.film, test.film, rules).equal()) << "Z is not clamped to 1";
    EXPECT_EQ(test.film.find("id.object")->bits[0], 3u);
}

TEST(Comparable, HalfRoundsBothAndRefusesCodes) {
    Film film = ramp();
    ComparableImage reference = as_comparable(film), test = reference;
    for (Plane& plane : test.film.planes)
        for (std::uint32_t& one : plane.bits)
            one = bits(encode(Encoding::half, std::bit_cast<float>(one)));
    EXPECT_FALSE(compare(reference.film, test.film).equal());
    encode_both(reference, test, Encoding::half);
    EXPECT_TRUE(compare(reference.film, test.film).equal());
    ComparableImage codes = as_comparable(film, Storage::unorm8);
    EXPECT_THROW(encode_both(reference, codes, Encoding::half), InputError);
    ComparableImage deep = as_comparable(film, Storage::unorm16);
    EXPECT_THROW(encode_both(reference, deep, Encoding::srgb8), InputError);
}

/// The film as an EXR of halves, rounded by OpenEXR's own type.
void write_halves(const std::filesystem::path& file, const Film& film) {
    Imf::Header header(film.frame.width(), film.frame.height());
    std::vector<std::vector<half>> planes;
    for (const Plane& plane : film.planes) {
        header.channels().insert(plane.name, Imf::Channel(Imf::HALF));
        std::vector<half>& halves = planes.emplace_back();
        for (const std::uint32_t one : plane.bits) halves.emplace_back(std::bit_cast<float>(one));
    }
    Imf::OutputFile output(file.c_str(), header);
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < planes.size(); ++i)
        buffer.insert(film.planes[i].name,
                      Imf::Slice::Make(Imf::HALF, planes[i].data(), header.dataWindow()));
    output.setFrameBuffer(buffer);
    output.writePixels(film.frame.height());
}

TEST(Comparable, AHalfExrPassesWithoutTolerance) {
    const TemporaryFolder folder;
    const Film film = ramp();
    write_halves(folder / "port.exr", film);
    ComparableImage reference = as_comparable(film);
    ComparableImage test = read_comparable(folder / "port.exr");
    EXPECT_EQ(test.stored.at("G"), Storage::half);
    EXPECT_FALSE(compare(reference.film, test.film).equal());
    const CompareRules rules{{}, {}, encode_both(reference, test, Encoding::half)};
    EXPECT_TRUE(compare(reference.film, test.film, rules).equal());
    Film off = test.film;
    off.planes[2].bits[77] += 0x2000;
    const CompareReport report = compare(reference.film, off, rules);
    EXPECT_FALSE(report.equal());
    EXPECT_EQ(report.channels[0].max_ulp + report.channels[1].max_ulp + report.channels[2].max_ulp,
              1u);
}

TEST(Comparable, FilesThatAreNoImages) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "text.png", "none");
    EXPECT_THROW(read_comparable(folder / "text.png"), InputError);
    EXPECT_THROW(read_comparable(folder / "missing.png"), InputError);
    EXPECT_THROW(read_comparable(folder.path()), InputError);
    write_png(folder / "a.png", Picture(2, 2, 7));
    EXPECT_EQ(read_comparable(folder / "a.png").film.planes.size(), 3u) << "after one that failed";
    EXPECT_THROW(read_comparable(folder / "a.png", {"layer", ""}), InputError);
}

}  // namespace
}  // namespace quadrel
