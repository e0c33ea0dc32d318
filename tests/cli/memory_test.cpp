// Memory that runs out while a file is read says nothing about the file: exit code 75.
#include <gtest/gtest.h>

#include <set>

#include "cli/process.hpp"
#include "effort.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/film/preview.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::TemporaryFolder;
using testing_films::write_bytes;

/// Runs with so much address space.
int run_within(rlim_t bytes, const std::vector<std::string>& arguments,
               const TemporaryFolder& folder) {
    const TemporaryFolder logs;
    const pid_t child = fork();
    if (child != 0) return wait_for(child);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
    _exit(wait_for(start(arguments, folder.path(), logs.path())) & 0xff);
}

/// The least address space in which the program itself starts.
rlim_t least_to_start(const TemporaryFolder& folder) {
    rlim_t low = 0, high = rlim_t{1} << 32;
    while (high - low > 1 << 20) {
        const rlim_t middle = (low + high) / 2;
        (run_within(middle, {"list", "channels"}, folder) == 0 ? high : low) = middle;
    }
    return high;
}

std::string large_obj() {
    std::string text;
    for (int i = 0; i < 30000; ++i) text += "v 0 0 " + std::to_string(i) + "\n";
    for (int i = 1; i < 29998; ++i)
        text += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " +
                std::to_string(i + 2) + "\n";
    return text;
}

class Memory : public testing::Test {
  protected:
    Memory() {
        Film film{{0, 0, 1500, 1500}, {0, 0, 1500, 1500}, {}};
        for (const char* name : {"R", "G", "B", "A"}) film.add(name, ChannelType::float32);
        write_exr(folder / "a.exr", film, {});
        write_png(folder / "a.png", preview(film));
        write_bytes(folder / "m.obj", large_obj());
        write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [8, 8],
            "objects": [{"mesh": {"file": "m.obj"}}]})");
        write_bytes(folder / "t.json",
                    R"({"quadrel": 1, "size": [8, 8], "objects": [{"mesh": "quad"}],
            "textures": {"t": {"file": "a.exr"}}, "material": {"color": "t"}})");
    }
    TemporaryFolder folder;
};

TEST_F(Memory, RunningOutInAReaderIsToBeTriedAgain) {
    if (test::sanitized) GTEST_SKIP() << "the sanitizers need address space without end";
    const rlim_t least = least_to_start(folder);
    for (const std::vector<std::string>& line :
         std::vector<std::vector<std::string>>{{"info", "a.exr"},
                                               {"info", "a.png"},
                                               {"info", "s.json"},
                                               {"mips", "a.exr", "-o", "m"}}) {
        std::set<int> codes;
        constexpr rlim_t step = 3 << 20;
        for (rlim_t more = step; more < 45 * step; more += more < 8 * step ? step : 6 * step)
            codes.insert(run_within(least + more, line, folder));
        EXPECT_TRUE(codes.contains(75)) << line[1] << ": memory runs out";
        codes.erase(75);
        codes.erase(0);
        EXPECT_TRUE(codes.empty()) << line[0] << " " << line[1] << " ends with " << *codes.begin();
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
