// Outputs that cannot be written, and those that are no files.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "cli/bad_input.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;

class BadOutputs : public testing::Test {
  protected:
    BadOutputs() { write_bytes(folder / "s.json", R"({"quadrel": 1, "size": [16, 16]})"); }

    testing::AssertionResult refuses(const BadInput& bad) const {
        const std::size_t before = folder.count();
        const testing::AssertionResult result = complains(run(bad.arguments, folder.path()), bad);
        if (result && folder.count() != before)
            return testing::AssertionFailure() << bad.what << ": something is left behind";
        return result;
    }
    TemporaryFolder folder;
};

TEST_F(BadOutputs, OutputsThatCannotBe) {
    write_bytes(folder / "file", "x");
    for (const char* output :
         {"/dev/full", "missing/a.exr", ".", "/proc/a.exr", "file/a.exr", "a/"})
        EXPECT_TRUE(refuses({output, {"render", "s.json", "-o", output}, 5, {}})) << output;
    EXPECT_TRUE(
        refuses({"stats", {"render", "s.json", "-o", "/dev/null", "--stats", "no/a"}, 5, {}}));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

/// A name that is empty is not the same as none, and one says what is written.
TEST_F(BadOutputs, NamesThatAreNone) {
    write_exr(folder / "a.exr", testing_films::smooth_film(1), {});
    using Words = std::vector<std::string>;
    const Words render = {"render", "s.json"}, compare = {"compare", "a.exr", "a.exr"},
                bake = {"bake", "a.exr", "--kind", "cone"}, sheet = {"sheet", "s.json"};
    struct Row {
        Words line, more;
        std::string says;
    };
    for (const Row& row : std::vector<Row>{{render, {"-o", ""}, "-o: found an empty text"},
                                           {render, {"--output="}, "--output"},
                                           {render, {"--preview", ""}, "--preview: found an"},
                                           {render, {"--stats", ""}, "--stats: found an"},
                                           {render, {"--channels", ""}, "--channels: found an"},
                                           {render, {"--size", ""}, "expected WxH"},
                                           {render, {"-D", ""}, "-D: found an"},
                                           {render, {"-t", ""}, "-t: found an"},
                                           {{"render", ""}, {}, "scene: found an"},
                                           {compare, {"--heatmap", ""}, "--heatmap: found an"},
                                           {compare, {"--blame", ""}, "--blame: found an"},
                                           {bake, {"-o", ""}, "-o: found an"},
                                           {bake, {"--packed", ""}, "--packed: found an"},
                                           {sheet, {"-o", ""}, "-o: found an"},
                                           {{"mips", "a.exr"}, {"-o", ""}, "expected PREFIX"},
                                           {render, {"-o", "name"}, "ends in .exr"},
                                           {render, {"-o", "name.tmp"}, "ends in .exr"},
                                           {render, {"--preview", "name"}, "ends in .png"},
                                           {render, {"--stats", "name.txt"}, "ends in .json"},
                                           {compare, {"--heatmap", "s.txt"}, "ends in .png"},
                                           {bake, {"-o", "name"}, "ends in .exr"},
                                           {bake, {"--packed", "name"}, "ends in .exr"},
                                           {sheet, {"-o", "name"}, "ends in .png"}}) {
        Words line = row.line;
        line.insert(line.end(), row.more.begin(), row.more.end());
        EXPECT_TRUE(refuses({row.says, line, 2, {row.says}})) << row.line[0];
    }
    EXPECT_TRUE(refuses({"no word", {"list", "channels", ""}, 2, {"words: found an empty text"}}));
    EXPECT_TRUE(refuses({"no verb", {"help", ""}, 2, {"found \"\", expected "}}));
    EXPECT_TRUE(refuses({"no list", {"list", ""}, 2, {"found \"\", expected one of algorithms"}}));
    EXPECT_EQ(run({"render", "s.json", "-o", "UPPER.EXR"}, folder.path()).code, 0);
}

TEST_F(BadOutputs, AReadOnlyFileStays) {
    write_bytes(folder / "old.exr", "old");
    chmod((folder / "old.exr").c_str(), 0400);
    const Outcome outcome = run({"render", "s.json", "-o", "old.exr"}, folder.path());
    if (geteuid() == 0) GTEST_SKIP() << "nothing is read-only to root";
    EXPECT_EQ(outcome.code, 5);
    EXPECT_EQ(file_bytes(folder / "old.exr"), "old");
}

TEST_F(BadOutputs, OutputsThroughLinksAndDevices) {
    std::filesystem::create_symlink("target.exr", folder / "link.exr");
    EXPECT_EQ(run({"render", "s.json", "-o", "link.exr"}, folder.path()).code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.exr"));
    EXPECT_EQ(read_exr(folder / "target.exr").film.window, (Window{0, 0, 16, 16}));
    EXPECT_EQ(run({"render", "s.json", "-o", "/dev/null"}, folder.path()).code, 0);
}

/// A limit on the size of files stands for a full disk. In the header, in the first chunk, and
/// among chunks that several threads compress.
TEST_F(BadOutputs, AFullDiskLeavesTheOldFile) {
    write_bytes(folder / "a.exr", "old");
    const std::size_t before = folder.count();
    for (const rlim_t room : {500, 30000, 200000}) {
        const TemporaryFolder logs;
        rlimit free{};
        getrlimit(RLIMIT_FSIZE, &free);
        const rlimit full{room, free.rlim_max};
        setrlimit(RLIMIT_FSIZE, &full);
        const pid_t child =
            start({"render", "s.json", "-o", "a.exr", "--size", "128x128", "--compression", "none"},
                  folder.path(), logs.path());
        setrlimit(RLIMIT_FSIZE, &free);
        const int code = wait_for(child);
        EXPECT_TRUE(
            complains({code, "", file_bytes(logs / "err")}, {"full", {}, 5, {"a.exr: cannot"}}));
        EXPECT_EQ(file_bytes(folder / "a.exr"), "old") << room;
        EXPECT_EQ(folder.count(), before) << room;
    }
}

TEST_F(BadOutputs, NoCompressionChangesPixels) {
    ASSERT_EQ(run({"render", "s.json", "-o", "a.exr"}, folder.path()).code, 0);
    for (const auto& [name, compression] : exr_compressions) {
        ASSERT_EQ(run({"render", "s.json", "-o", "b.exr", "--compression", std::string(name)},
                      folder.path())
                      .code,
                  0);
        EXPECT_EQ(read_exr(folder / "b.exr").film, read_exr(folder / "a.exr").film) << name;
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
