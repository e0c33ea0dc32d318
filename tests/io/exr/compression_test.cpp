// Writing with every compression and number of threads: the pixels are the same, for us and for
// OpenEXR's C++ library.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "io/exr/encode.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::TemporaryFolder;

using Writer = std::function<void(const std::filesystem::path&, const Film&, const ExrWriting&)>;

const Attributes attributes = {{"quadrel:scene", "0123"},
                               {"quadrel:a name of more than 31 characters", "long"}};

void write_plainly(const std::filesystem::path& file, const Film& film, const ExrWriting& writing) {
    write_exr(file, film, attributes, writing);
}

/// Several bands of chunks of every compression, the last one not full; noise beside what shrinks.
Film tall_film() {
    const Window window{-3, 5, 26, 5 + 101};
    Film film = testing_films::random_film(3, {-10, 0, 40, 120}, window);
    Plane& ramp = film.add("ramp", ChannelType::float32);
    for (std::size_t i = 0; i < ramp.bits.size(); ++i)
        ramp.bits[i] = std::bit_cast<std::uint32_t>(static_cast<float>(i / 29));
    film.add("zero", ChannelType::uint32);
    return testing_films::sorted_by_name(film);
}

/// What OpenEXR's own reader sees.
Film read_by_openexr(const std::filesystem::path& file) {
    Imf::InputFile input(file.c_str());
    const Imath::Box2i box = input.header().dataWindow(), frame = input.header().displayWindow();
    Film film;
    film.frame = {frame.min.x, frame.min.y, frame.max.x + 1, frame.max.y + 1};
    film.window = {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1};
    Imf::FrameBuffer buffer;
    for (auto i = input.header().channels().begin(); i != input.header().channels().end(); ++i)
        film.add(i.name(),
                 i.channel().type == Imf::UINT ? ChannelType::uint32 : ChannelType::float32);
    for (Plane& plane : film.planes)
        buffer.insert(plane.name,
                      Imf::Slice::Make(plane.type == ChannelType::uint32 ? Imf::UINT : Imf::FLOAT,
                                       plane.bits.data(), box));
    input.setFrameBuffer(buffer);
    input.readPixels(box.min.y, box.max.y);
    return film;
}

AssertionResult keeps_pixels(const Writer& writer) {
    const TemporaryFolder folder;
    Film film = tall_film(), expected = film;
    canonicalize(expected);
    for (const auto& [name, compression] : exr_compressions) {
        std::set<std::string> files;
        for (const int threads : {1, 2, 5}) {
            const auto file = folder / (std::string(name) + ".exr");
            writer(file, film, {compression, threads});
            files.insert(testing_films::file_bytes(file));
            const ExrFile read = read_exr(file);
            if (read.film != expected) return AssertionFailure() << name << ": another film";
            if (read.attributes != attributes) return AssertionFailure() << name << ": attributes";
            if (read_by_openexr(file) != expected)
                return AssertionFailure() << name << ": another film to OpenEXR";
        }
        if (files.size() != 1) return AssertionFailure() << name << ": threads show";
    }
    return AssertionSuccess();
}

void write_with(FilmError error, const std::filesystem::path& file, Film film,
                const ExrWriting& writing) {
    const auto width = static_cast<std::ptrdiff_t>(film.window.width());
    for (Plane& plane : film.planes) {
        const auto rows = plane.bits.begin();
        if (error == FilmError::chunks_swapped)
            std::rotate(rows, rows + 16 * width, rows + 32 * width);
        if (error == FilmError::rows_off_by_band)
            std::rotate(rows + 32 * width, rows + 63 * width, rows + 64 * width);
    }
    write_plainly(file, film, writing);
}

TEST(Compression, KeepsPixels) {
    EXPECT_TRUE(keeps_pixels(write_plainly));
    for (const FilmError error : {FilmError::chunks_swapped, FilmError::rows_off_by_band})
        EXPECT_FALSE(keeps_pixels([&](const auto& file, const Film& film, const auto& writing) {
            write_with(error, file, film, writing);
        }));
}

TEST(Compression, IsTheOneAskedFor) {
    const TemporaryFolder folder;
    const std::pair<ExrCompression, Imf::Compression> all[] = {
        {ExrCompression::none, Imf::NO_COMPRESSION},
        {ExrCompression::rle, Imf::RLE_COMPRESSION},
        {ExrCompression::zips, Imf::ZIPS_COMPRESSION},
        {ExrCompression::zip, Imf::ZIP_COMPRESSION},
        {ExrCompression::piz, Imf::PIZ_COMPRESSION}};
    for (const auto& [compression, expected] : all) {
        write_exr(folder / "a.exr", tall_film(), attributes, {compression});
        EXPECT_EQ(Imf::InputFile((folder / "a.exr").c_str()).header().compression(), expected);
    }
    write_exr(folder / "a.exr", tall_film(), attributes);
    EXPECT_EQ(Imf::InputFile((folder / "a.exr").c_str()).header().compression(),
              Imf::ZIP_COMPRESSION);
}

/// A chunk that is as long compressed as it was must be stored as it was. Of such films, an opaque
/// 2x2 image of few values, one in five has one by zip.
TEST(Compression, OfChunksThatDoNotShrink) {
    const TemporaryFolder folder;
    std::mt19937 random(1);
    for (int i = 0; i < 40; ++i) {
        Film film{{0, 0, 2, 2}, {0, 0, 2, 2}, {}};
        for (const char* name : {"A", "B", "G", "R"})
            for (std::uint32_t& bits : film.add(name, ChannelType::float32).bits)
                bits = *name == 'A'
                           ? 0x3f800000u
                           : 0x3c000000u + (static_cast<std::uint32_t>(random() % 64) << 13);
        for (const auto& [name, compression] : exr_compressions) {
            testing_films::write_bytes(folder / "a.exr", exr_bytes(film, {}, {compression, 1}));
            ASSERT_TRUE(read_exr(folder / "a.exr").film == film) << name << " " << i;
        }
    }
}

/// Wherever the output fails, its own error comes through, and no output is asked again.
TEST(Compression, ErrorsOfTheOutputComeThrough) {
    const Film film = tall_film();
    const ExrPartView part{nullptr, &film, &attributes};
    const std::size_t whole = exr_bytes(film, attributes).size();
    for (std::size_t room = 0; room < whole; room += whole / 40) {
        int refused = 0;
        const auto output = [&](std::uint64_t position, const void*, std::size_t size) {
            if (position + size <= room) return;
            ++refused;
            throw OutputError("full", "no room");
        };
        EXPECT_THROW(encode_exr({&part, 1}, {ExrCompression::zip, 3}, output), OutputError) << room;
        EXPECT_EQ(refused, 1) << room;
    }
}

}  // namespace
}  // namespace quadrel
