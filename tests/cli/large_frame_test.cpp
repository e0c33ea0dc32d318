// Memory of what is large: of frames that are written as they are drawn it grows with a band of
// tiles, not with the frame; of displaced meshes it is what is stated before they are made.
#include <gtest/gtest.h>

#include "cli/process.hpp"
#include "effort.hpp"
#include "film/films.hpp"
#include "quadrel/scene/displace.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

/// Largest resident size of `quadrel arguments...` in MB.
long peak_of(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
    const TemporaryFolder logs;
    const pid_t child = start(arguments, folder.path(), logs.path());
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    EXPECT_EQ(status, 0) << file_bytes(logs / "err");
    return usage.ru_maxrss / 1024;
}

class LargeFrame : public testing::Test {
  protected:
    LargeFrame() {
        write_bytes(folder / "s.json", R"({"quadrel": 1,
            "objects": [{"mesh": "quad", "transform": [{"scale": 0.1}]}]})");
    }
    long peak(const std::string& size, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments = {"render",        "s.json", "-o",     "a.exr",
                                              "--size",        size,     "-t",     "2",
                                              "--compression", "rle",    "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return peak_of(arguments, folder);
    }
    TemporaryFolder folder;
};

/// A film would be 537 MB, of one channel alone.
TEST_F(LargeFrame, OfAHundredMillionPixelsTakesLessThan300MB) {
    if (test::sanitized) GTEST_SKIP() << "the sanitizers' memory is more than that";
    EXPECT_LT(peak("8192x16384", {"--channels", "A"}), 300);
}

/// Four times the rows are as good as no more memory; a preview keeps the channels that it spreads,
/// 4 bytes per pixel here, so that this would notice a film that is kept.
TEST_F(LargeFrame, RowsTakeNoMemory) {
    if (test::sanitized) GTEST_SKIP() << "the sanitizers' memory is more than that";
    const std::vector<std::string> keeps = {"--channels", "A,Z", "--preview", "a.png"};
    const long few = peak("2048x1024"), many = peak("2048x4096"), kept = peak("2048x4096", keeps);
    EXPECT_LT(many, few + 12);
    EXPECT_GT(kept, few + 24) << "a film of one channel is noticed";
}

/// A million triangles on a small picture. That they were all kept as they are drawn would be
/// noticed: 400 bytes each.
TEST_F(LargeFrame, DisplacedMeshesTakeTheMemoryThatIsStated) {
    if (test::sanitized) GTEST_SKIP() << "the sanitizers' memory is more than that";
    write_bytes(folder / "s.json", R"({"quadrel": 1, "objects": [{"mesh": {"shape": "quad",
        "displace": {"cells": 2, "height": {"file": ")" QUADREL_DATA_DIR
                                   R"(/textures/obstacles_height.exr"}}}}]})");
    constexpr std::uint64_t cells = 700;
    const DisplacedSize size{0, 2 * cells * cells, (cells + 1) * (cells + 1)};
    const auto stated = static_cast<long>(size.bytes() >> 20);
    const long least = peak("64x64");
    const long most = peak("64x64", {"-D", "objects[0].mesh.displace.cells=700"});
    EXPECT_LT(most - least, stated + stated / 3);
    EXPECT_GT(most - least, stated / 2);
}

}  // namespace
}  // namespace quadrel::cli_tests
