// EXR files whose headers claim more than the file can hold: refused by both readers before
// anything is allocated.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "film/films.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel {
namespace {

using testing_films::TemporaryFolder;
using Reader = std::function<void(const std::filesystem::path&)>;

const Reader as_film = [](const auto& file) { read_exr(file); };
const Reader as_image = [](const auto& file) { load_image(file); };
/// Believes everything.
const Reader as_nothing = [](const auto&) {};

std::string whole_file(const TemporaryFolder& folder) {
    Film film{{0, 0, 16, 16}, {0, 0, 16, 16}, {}};  // of zeros: small when compressed
    for (const char* name : {"R", "G", "B", "A"}) film.add(name, ChannelType::float32);
    write_exr(folder / "whole.exr", film, {});
    return testing_films::file_bytes(folder / "whole.exr");
}

/// The bytes with a number in place of another, `offset` bytes behind the text `behind`.
std::string patched(std::string bytes, const std::string& behind, std::size_t offset,
                    std::int32_t number) {
    const std::size_t at = bytes.find(behind);
    EXPECT_NE(at, std::string::npos) << behind;
    std::memcpy(&bytes[at + behind.size() + offset], &number, sizeof number);
    return bytes;
}

testing::AssertionResult refuses(const Reader& read, const std::string& bytes,
                                 const std::string& found) {
    const TemporaryFolder folder;
    testing_films::write_bytes(folder / "a.exr", bytes);
    try {
        read(folder / "a.exr");
    } catch (const InputError& error) {
        if (error.found.find(found) != std::string::npos) return testing::AssertionSuccess();
        return testing::AssertionFailure() << "another complaint: " << error.what();
    }
    return testing::AssertionFailure() << "accepted";
}

const std::string type_name("compression\0compression\0", 24);
const std::string data_window("dataWindow\0box2i\0\x10\0\0\0", 21);
const std::string display_window("displayWindow\0box2i\0\x10\0\0\0", 24);

TEST(ExrLimits, WholeFilesAreRead) {
    const TemporaryFolder folder;
    whole_file(folder);
    EXPECT_NO_THROW(as_film(folder / "whole.exr"));
    EXPECT_NO_THROW(as_image(folder / "whole.exr"));
}

TEST(ExrLimits, AttributesLongerThanTheFile) {
    const TemporaryFolder folder;
    const std::string huge = patched(whole_file(folder), type_name, 0, 0x70000000);
    const std::string negative = patched(whole_file(folder), type_name, 0, -1);
    for (const Reader& read : {as_film, as_image}) {
        EXPECT_TRUE(refuses(read, huge, "an attribute \"compression\" of 1879048192 bytes"));
        EXPECT_TRUE(refuses(read, negative, "an attribute \"compression\" of 4294967295 bytes"));
    }
    EXPECT_FALSE(refuses(as_nothing, huge, ""));
}

/// By which nothing can be divided, since OpenEXR then counts no scan lines per chunk.
TEST(ExrLimits, ScanLinesThatDescribeTiles) {
    const TemporaryFolder folder;
    std::string bytes = whole_file(folder);
    const std::string tiles("tiles\0tiledesc\0\x9\0\0\0\x10\0\0\0\x10\0\0\0\0", 28);
    bytes.insert(bytes.find(type_name), tiles);
    for (const Reader& read : {as_film, as_image})
        EXPECT_TRUE(refuses(read, bytes, "scan lines with a description of tiles"));
}

TEST(ExrLimits, HeadersThatDoNotEnd) {
    const TemporaryFolder folder;
    const std::string whole = whole_file(folder);
    const std::size_t start = whole.find("compression");
    for (const Reader& read : {as_film, as_image}) {
        EXPECT_TRUE(refuses(read, whole.substr(0, start + 5), "the end of the file"));
        EXPECT_TRUE(refuses(read, whole.substr(0, start) + std::string(300, 'n') + whole,
                            "a name of more than 255 bytes"));
    }
}

TEST(ExrLimits, WindowsLargerThanTheFile) {
    const TemporaryFolder folder;
    const std::string data = patched(whole_file(folder), data_window, 8, 65535);  // greatest x
    EXPECT_TRUE(refuses(as_film, data, "4194304 values"));
    EXPECT_TRUE(refuses(as_image, data, "1048576 pixels of 4 channels"));
    const std::string display = patched(whole_file(folder), display_window, 8, 65535);
    EXPECT_TRUE(refuses(as_image, display, "1048576 pixels of 4 channels"));
    EXPECT_FALSE(refuses(as_nothing, display, ""));
}

}  // namespace
}  // namespace quadrel
