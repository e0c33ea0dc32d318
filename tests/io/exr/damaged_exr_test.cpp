// Damaged files: equal bytes give equal pixels, whatever lay in memory before, or are refused.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::TemporaryFolder;

constexpr int width = 45, height = 37;

/// Halves, floats and integers, so that every way in which DWA packs a channel occurs.
void write_film(const std::filesystem::path& file, Imf::Compression compression, bool tiled,
                const std::vector<std::string>& names = {"R", "G", "Z", "A", "id"}) {
    Imf::Header header(width, height);
    header.compression() = compression;
    std::vector<std::vector<std::uint32_t>> values;
    Imf::FrameBuffer buffer;
    std::mt19937 random(1);
    for (const std::string& name : names) {
        const Imf::PixelType type = name == "id" ? Imf::UINT : name == "Z" ? Imf::FLOAT : Imf::HALF;
        header.channels().insert(name, Imf::Channel(type));
        std::vector<std::uint32_t>& plane = values.emplace_back();
        for (int i = 0; i < width * height; ++i) {
            const float value =
                static_cast<float>(i % width) / width + static_cast<float>(random() % 64) / 1024;
            const std::uint32_t bits = type == Imf::HALF    ? half(value).bits()
                                       : type == Imf::FLOAT ? std::bit_cast<std::uint32_t>(value)
                                                            : static_cast<std::uint32_t>(i / 9);
            plane.push_back(bits);
        }
    }
    for (std::size_t c = 0; c < names.size(); ++c)
        buffer.insert(names[c],
                      Imf::Slice(header.channels()[names[c]].type,
                                 reinterpret_cast<char*>(values[c].data()), 4, 4 * width));
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(16, 16, Imf::ONE_LEVEL));
        Imf::TiledOutputFile output(file.c_str(), header, 0);
        output.setFrameBuffer(buffer);
        output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
    } else {
        Imf::OutputFile output(file.c_str(), header, 0);
        output.setFrameBuffer(buffer);
        output.writePixels(height);
    }
}

/// Leaves a pattern in memory that is about to be handed out again.
void poison(unsigned char pattern) {
    for (std::size_t size = 64; size <= std::size_t{1} << 18; size += size / 2) {
        std::vector<std::vector<unsigned char>> blocks(3,
                                                       std::vector<unsigned char>(size, pattern));
        for (auto& block : blocks) std::memset(block.data(), pattern, block.size());
    }
}

using Read = std::function<Film(const std::filesystem::path&)>;

/// What a reader gives, or nothing if it refuses.
Film outcome(const Read& read, const std::filesystem::path& file, unsigned char pattern) {
    poison(pattern);
    try {
        return read(file);
    } catch (const std::exception&) {
        return {};
    }
}

Film read_with_quadrel(const std::filesystem::path& file) { return read_exr(file).film; }

/// As OpenEXR's C++ library reads it: FilmError::stale_memory.
Film read_with_library(const std::filesystem::path& file) {
    Imf::InputFile input(file.c_str(), 0);
    Film film{{0, 0, width, height}, {0, 0, width, height}, {}};
    Imf::FrameBuffer buffer;
    for (auto i = input.header().channels().begin(); i != input.header().channels().end(); ++i)
        film.add(i.name(),
                 i.channel().type == Imf::UINT ? ChannelType::uint32 : ChannelType::float32);
    for (Plane& plane : film.planes)
        buffer.insert(plane.name,
                      Imf::Slice(plane.type == ChannelType::uint32 ? Imf::UINT : Imf::FLOAT,
                                 reinterpret_cast<char*>(plane.bits.data()), 4, 4 * width));
    input.setFrameBuffer(buffer);
    input.readPixels(0, height - 1);
    return film;
}

AssertionResult same_whatever_lay_in_memory(const Read& read, const std::filesystem::path& file) {
    const Film first = outcome(read, file, 0x55), second = outcome(read, file, 0xaa);
    if (first != second) return AssertionFailure() << "two results of the same bytes";
    return AssertionSuccess();
}

std::string damaged(std::string bytes, std::mt19937& random) {
    for (unsigned i = 0; i <= random() % 4; ++i) {
        const std::size_t at = 300 + random() % (bytes.size() - 340);
        const std::uint32_t number = random() % 64;
        if (random() % 2 == 0)
            std::memcpy(&bytes[at], &number, 4);
        else
            std::memset(&bytes[at], random() % 2 == 0 ? 0 : 255, random() % 40);
    }
    return bytes;
}

TEST(DamagedExr, EqualBytesGiveEqualPixels) {
    const TemporaryFolder folder;
    std::mt19937 random(7);
    int refused = 0, count = 0;
    for (const Imf::Compression compression :
         {Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION})
        for (const bool tiled : {false, true}) {
            write_film(folder / "whole.exr", compression, tiled);
            const std::string whole = testing_films::file_bytes(folder / "whole.exr");
            for (int i = 0; i < 25; ++i, ++count) {
                testing_films::write_bytes(folder / "bad.exr", damaged(whole, random));
                EXPECT_TRUE(same_whatever_lay_in_memory(read_with_quadrel, folder / "bad.exr"));
                if (outcome(read_with_quadrel, folder / "bad.exr", 0).planes.empty()) ++refused;
            }
        }
    EXPECT_GT(refused, count / 2) << "what can be detected is refused";
}

TEST(DamagedExr, WholeFilesAreAsTheLibraryReadsThem) {
    const TemporaryFolder folder;
    for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
        for (const bool tiled : {false, true}) {
            write_film(folder / "whole.exr", Imf::Compression(compression), tiled);
            EXPECT_EQ(read_with_quadrel(folder / "whole.exr"),
                      read_with_library(folder / "whole.exr"))
                << compression;
        }
}

/// A chunk that says that its only block, of deflated values, has no bytes.
std::string without_values(std::string bytes) {
    // The offset table ends where the first chunk begins: y, the bytes, eleven counters.
    const std::size_t end = bytes.find(std::string("\0\0", 2), bytes.find("screenWindowWidth"));
    for (std::size_t at = end; at + 16 < bytes.size(); ++at) {
        std::uint64_t counters[3];
        std::memcpy(counters, &bytes[at], sizeof counters);
        if (counters[0] != 2 || counters[1] != std::uint64_t{4} * width * 32) continue;
        std::memset(&bytes[at + 16], 0, 8);
        return bytes;
    }
    ADD_FAILURE() << "no chunk";
    return bytes;
}

TEST(DamagedExr, ABlockOfNoBytesIsRefused) {
    const TemporaryFolder folder;
    write_film(folder / "whole.exr", Imf::DWAA_COMPRESSION, false, {"id"});
    EXPECT_EQ(read_with_quadrel(folder / "whole.exr").planes.size(), 1u);
    testing_films::write_bytes(folder / "bad.exr",
                               without_values(testing_films::file_bytes(folder / "whole.exr")));
    EXPECT_THROW(read_with_quadrel(folder / "bad.exr"), InputError);
    EXPECT_NO_THROW(read_with_library(folder / "bad.exr"));
#ifndef __SANITIZE_ADDRESS__  // which hands out memory in its own ways
    EXPECT_FALSE(same_whatever_lay_in_memory(read_with_library, folder / "bad.exr"));
#endif
}

/// A channel of this name that is sampled every 0 rows, of which OpenEXR complains by name.
void write_badly_sampled(const std::filesystem::path& file, const std::string& name) {
    write_film(file, Imf::NO_COMPRESSION, false, {name});
    std::string bytes = testing_films::file_bytes(file);
    // After the name: its 0, the type, four bytes for linearity, then sampling in x and in y.
    const std::size_t sampling = bytes.find(name) + name.size() + 1 + 4 + 4 + 4;
    std::memset(&bytes[sampling], 0, 4);
    testing_films::write_bytes(file, bytes);
}

AssertionResult is_refused(const std::string& channel) {
    const TemporaryFolder folder;
    write_badly_sampled(folder / "bad.exr", channel);
    try {
        read_with_quadrel(folder / "bad.exr");
    } catch (const InputError& error) {
        return AssertionResult(std::string(error.what()).find(channel) != std::string::npos)
               << error.what();
    } catch (const std::bad_alloc&) {
        return AssertionFailure() << "out of memory";
    }
    return AssertionFailure() << "read";
}

/// Damaged codes make the library say so where memory is plenty.
TEST(DamagedExr, CodesThatCannotBeAreNoLackOfMemory) {
    const TemporaryFolder folder;
    write_film(folder / "whole.exr", Imf::PIZ_COMPRESSION, false);
    const std::string bytes = testing_films::file_bytes(folder / "whole.exr");
    int refused = 0;
    for (std::size_t at = bytes.size() / 4; at < bytes.size(); at += 37) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 0x80);
        testing_films::write_bytes(folder / "bad.exr", changed);
        try {
            read_with_quadrel(folder / "bad.exr");
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

TEST(DamagedExr, ANameIsNoLackOfMemory) {
    EXPECT_TRUE(is_refused("height"));
    EXPECT_TRUE(is_refused("std::bad_alloc"));
    EXPECT_TRUE(is_refused("Out of memory"));
}

}  // namespace
}  // namespace quadrel
