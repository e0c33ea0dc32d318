#include "quadrel/film/exr.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <gtest/gtest.h>

#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::TemporaryFolder;
using Writer = std::function<void(const std::filesystem::path&, const Film&, const Attributes&)>;

const Attributes attributes = {{"quadrel:scene", "0123"}, {"quadrel:note", "two\nlines, \"q\""}};

AssertionResult round_trips(const Writer& writer) {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 4; ++seed) {
        Film film = testing_films::sorted_by_name(testing_films::random_film(seed));
        writer(folder / "a.exr", film, attributes);
        canonicalize(film);
        const ExrFile read = read_exr(folder / "a.exr");
        if (read.film != film) return AssertionFailure() << "another film, seed " << seed;
        if (read.attributes != attributes) return AssertionFailure() << "other attributes";
        if (read.stored.at("R") != StoredType::float32 ||
            read.stored.at("hit.steps") != StoredType::uint32)
            return AssertionFailure() << "stored types";
    }
    return AssertionSuccess();
}

float through_half(float value) { return static_cast<float>(half(value)); }

void write_with(FilmError error, const std::filesystem::path& file, Film film) {
    for (Plane& plane : film.planes) {
        if (plane.type != ChannelType::float32) continue;
        for (std::uint32_t& bits : plane.bits) {
            const float value = std::bit_cast<float>(bits);
            if (error == FilmError::half_pixels)
                bits = std::bit_cast<std::uint32_t>(through_half(value));
            if (error == FilmError::nan_dropped && value != value) bits = 0;
        }
    }
    if (error == FilmError::window_shifted) film.window = {4, 2, 13, 11};
    write_exr(file, film, attributes);
}

TEST(Exr, RoundTripKeepsEveryBit) {
    EXPECT_TRUE(round_trips([](const auto& file, const Film& film, const Attributes& of_file) {
        write_exr(file, film, of_file);
    }));
    for (const FilmError error :
         {FilmError::half_pixels, FilmError::nan_dropped, FilmError::window_shifted})
        EXPECT_FALSE(round_trips([&](const auto& file, const Film& film, const Attributes&) {
            write_with(error, file, film);
        }));
}

TEST(Exr, WindowsMayLieAnywhere) {
    const TemporaryFolder folder;
    for (const Window window :
         {Window{0, 0, 1, 1}, Window{-5, -7, 4, 2}, Window{100, 90, 109, 99}}) {
        Film film{{-10, -10, 200, 200}, window, {}};
        film.add("Y", ChannelType::float32, 0x3f800000);
        write_exr(folder / "w.exr", film, {});
        EXPECT_EQ(read_exr(folder / "w.exr").film, film);
    }
}

TEST(Exr, EqualFilmsGiveEqualBytes) {
    const TemporaryFolder folder;
    Film film = testing_films::random_film(7);
    write_exr(folder / "a.exr", film, attributes);
    std::swap(film.planes[0], film.planes[5]);
    canonicalize(film);
    write_exr(folder / "b.exr", film, attributes);
    EXPECT_EQ(testing_films::file_bytes(folder / "a.exr"),
              testing_films::file_bytes(folder / "b.exr"));
    EXPECT_EQ(testing_films::file_bytes(folder / "a.exr"), exr_bytes(film, attributes));
    film.planes[0].bits[50] ^= 1;
    EXPECT_NE(testing_films::file_bytes(folder / "a.exr"), exr_bytes(film, attributes));
    write_exr(folder / "c.exr", film, attributes);
    EXPECT_NE(testing_films::file_bytes(folder / "a.exr"),
              testing_films::file_bytes(folder / "c.exr"));
}

TEST(Exr, EveryTruncationIsRefused) {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", testing_films::random_film(8), attributes);
    const std::string bytes = testing_films::file_bytes(folder / "a.exr");
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 200) {
        testing_films::write_bytes(folder / "cut.exr", bytes.substr(0, size));
        EXPECT_THROW(read_exr(folder / "cut.exr"), InputError) << size;
    }
    testing_films::write_bytes(folder / "cut.exr", bytes.substr(0, bytes.size() - 1));
    EXPECT_THROW(read_exr(folder / "cut.exr"), InputError);
}

TEST(Exr, DamagedBytesAreRefusedOrReadButNeverCrash) {
    const TemporaryFolder folder;
    write_exr(folder / "a.exr", testing_films::random_film(9), attributes);
    const std::string bytes = testing_films::file_bytes(folder / "a.exr");
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string damaged = bytes;
        damaged[random() % std::min<std::size_t>(bytes.size(), 600)] = static_cast<char>(random());
        testing_films::write_bytes(folder / "bad.exr", damaged);
        try {
            read_exr(folder / "bad.exr");
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 50);
}

TEST(Exr, WhatIsNoImageIsRefused) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "text.exr", "not an image, though long enough");
    testing_films::write_bytes(folder / "empty.exr", "");
    EXPECT_THROW(read_exr(folder / "text.exr"), InputError);
    EXPECT_THROW(read_exr(folder / "empty.exr"), InputError);
    EXPECT_THROW(read_exr(folder / "missing.exr"), InputError);
    EXPECT_THROW(read_exr(folder.path()), InputError);
}

void write_half(const std::filesystem::path& file, const std::vector<half>& pixels) {
    Imf::Header header(static_cast<int>(pixels.size()), 1);
    header.channels().insert("R", Imf::Channel(Imf::HALF));
    Imf::OutputFile output(file.c_str(), header);
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice::Make(Imf::HALF, pixels.data(), header.dataWindow()));
    output.setFrameBuffer(buffer);
    output.writePixels(1);
}

TEST(Exr, EveryHalfIsReadExactly) {
    const TemporaryFolder folder;
    std::vector<half> pixels(65536);
    for (unsigned i = 0; i < pixels.size(); ++i) pixels[i].setBits(static_cast<unsigned short>(i));
    write_half(folder / "half.exr", pixels);
    const ExrFile read = read_exr(folder / "half.exr");
    EXPECT_EQ(read.stored.at("R"), StoredType::half);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        ASSERT_EQ(read.film.planes[0].bits[i],
                  canonical_bits(std::bit_cast<std::uint32_t>(static_cast<float>(pixels[i]))));
}

void write_two_parts(const std::filesystem::path& file) {
    std::vector<Imf::Header> headers(2, Imf::Header(2, 2));
    for (int part = 0; part < 2; ++part) {
        Imf::Header& header = headers[static_cast<std::size_t>(part)];
        header.setName(part == 0 ? "first" : "second");
        header.setType(Imf::SCANLINEIMAGE);
        header.channels().insert(part == 0 ? "R" : "depth.Z", Imf::Channel(Imf::FLOAT));
        header.channels().insert("extra.R", Imf::Channel(Imf::FLOAT));
    }
    Imf::MultiPartOutputFile output(file.c_str(), headers.data(), 2);
    for (int part = 0; part < 2; ++part) {
        const float pixels[4] = {1, 2, 3, static_cast<float>(part)};
        Imf::FrameBuffer buffer;
        for (const char* name : {part == 0 ? "R" : "depth.Z", "extra.R"})
            buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, pixels, headers[0].dataWindow()));
        Imf::OutputPart target(output, part);
        target.setFrameBuffer(buffer);
        target.writePixels(2);
    }
}

TEST(Exr, PartsAndLayersByName) {
    const TemporaryFolder folder;
    write_two_parts(folder / "parts.exr");
    EXPECT_THROW(read_exr(folder / "parts.exr"), InputError) << "which one?";
    const ExrFile first = read_exr(folder / "parts.exr", {"", "0"});
    EXPECT_EQ(first.parts, (std::vector<std::string>{"first", "second"}));
    ASSERT_NE(first.film.find("R"), nullptr);
    EXPECT_EQ(first.film.find("R")->as_float(3), 0);
    const ExrFile second = read_exr(folder / "parts.exr", {"", "second"});
    ASSERT_NE(second.film.find("depth.Z"), nullptr);
    EXPECT_EQ(second.film.find("depth.Z")->as_float(3), 1);
    EXPECT_THROW(read_exr(folder / "parts.exr", {"extra", ""}), InputError) << "in both parts";
    const ExrFile layer = read_exr(folder / "parts.exr", {"extra", "first"});
    ASSERT_EQ(layer.film.planes.size(), 1u);
    EXPECT_EQ(layer.film.planes[0].name, "R");
    EXPECT_EQ(read_exr(folder / "parts.exr", {"second", ""}).film, second.film);
    EXPECT_THROW(read_exr(folder / "parts.exr", {"none", ""}), InputError);
    EXPECT_THROW(read_exr(folder / "parts.exr", {"", "none"}), InputError);
    const std::vector<ExrPartInfo> parts = exr_parts(folder / "parts.exr");
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[1].name, "second");
    EXPECT_EQ(parts[1].channels, (std::vector<std::string>{"depth.Z", "extra.R"}));
}

}  // namespace
}  // namespace quadrel
