// quadrel render: outputs whole or not at all.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;

class Render : public testing::Test {
  protected:
    void SetUp() override {
        const std::vector<std::string> names = installed_scenes();
        if (names.empty()) GTEST_SKIP() << "no installed scene";
        scene = names[0];
    }
    Outcome render(std::vector<std::string> options) {
        options.insert(options.begin(), {"render", scene, "--size", "48x32"});
        return run(options, folder.path());
    }
    std::string scene;
    TemporaryFolder folder;
};

TEST_F(Render, WritesWhatWasAskedForAndSaysWhere) {
    const Outcome outcome = render({"-o", "a.exr", "--channels", "uv,Z", "--preview", "a.png"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find((folder / "a.exr").string() + "\n"), std::string::npos);
    EXPECT_NE(outcome.err.find((folder / "a.png").string() + "\n"), std::string::npos);
    const ExrFile file = read_exr(folder / "a.exr");
    EXPECT_EQ(file.film.window, (Window{0, 0, 48, 32}));
    EXPECT_EQ(file.film.planes.size(), 3u);
    EXPECT_FALSE(file.attributes.empty());
    EXPECT_EQ(folder.count(), 2u);
}

TEST_F(Render, DefaultNameIsTheScenes) {
    ASSERT_EQ(render({}).code, 0);
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / (scene + ".exr")));
}

TEST_F(Render, WindowIsAPartOfTheFrame) {
    ASSERT_EQ(render({"-o", "all.exr"}).code, 0);
    ASSERT_EQ(render({"-o", "part.exr", "--window", "5,3,20,31"}).code, 0);
    const Film all = read_exr(folder / "all.exr").film, part = read_exr(folder / "part.exr").film;
    EXPECT_EQ(part.frame, all.frame);
    EXPECT_EQ(part.window, (Window{5, 3, 20, 31}));
    for (const Plane& plane : part.planes)
        for (int y = 3; y < 31; ++y)
            for (int x = 5; x < 20; ++x)
                ASSERT_EQ(plane.bits[part.index(x, y)],
                          all.find(plane.name)->bits[all.index(x, y)]);
    EXPECT_EQ(render({"-o", "a.exr", "--window", "5,3,49,31"}).code, 2);
}

TEST_F(Render, TakesValuesFromAnImage) {
    ASSERT_EQ(render({"-o", "all.exr", "--channels", "A,hit,N,R"}).code, 0);
    const Film all = read_exr(folder / "all.exr").film;
    ASSERT_EQ(render({"-o", "same.exr", "--channels", "A,hit,N,R", "--inject", "hit.uv=all.exr",
                      "--inject", "hit.s,N=all.exr"})
                  .code,
              0);
    EXPECT_EQ(read_exr(folder / "same.exr").film, all);
    Film other = all;
    for (std::uint32_t& bits : other.find("N.X")->bits) bits = 0x3f000000u;
    write_exr(folder / "other.exr", other, {});
    ASSERT_EQ(
        render({"-o", "moved.exr", "--channels", "A,hit,N,R", "--inject", "N=other.exr"}).code, 0);
    const Film moved = read_exr(folder / "moved.exr").film;
    EXPECT_EQ(moved.find("hit.U")->bits, all.find("hit.U")->bits);
    EXPECT_NE(moved.find("N.X")->bits, all.find("N.X")->bits);
    EXPECT_NE(moved.find("R")->bits, all.find("R")->bits);
    const Outcome plan = render({"--explain", "--inject", "N=other.exr"});
    EXPECT_NE(plan.out.find("takes N=other.exr"), std::string::npos) << plan.out;
    // The probe shows what the render had.
    const Outcome probe =
        run({"probe", scene, "--size", "48x32", "--pixel", "24,16", "--inject", "N=other.exr"},
            folder.path());
    EXPECT_EQ(probe.code, 0) << probe.err;
    EXPECT_NE(probe.out.find("0x1p-1"), std::string::npos) << probe.out;
}

TEST_F(Render, ImagesThatDoNotFitAreNotInjected) {
    ASSERT_EQ(render({"-o", "all.exr", "--channels", "hit"}).code, 0);
    const std::string before = file_bytes(folder / "all.exr");
    const auto code = [&](const std::string& option, const std::string& says,
                          const std::string& output = "a.exr") {
        const Outcome outcome = render({"-o", output, "--inject", option});
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        return outcome.code;
    };
    EXPECT_EQ(code("hit.uv", "NAME=FILE"), 2);
    EXPECT_EQ(code("=all.exr", "NAME=FILE"), 2);
    EXPECT_EQ(code("hit.uw=all.exr", "hit.uw"), 2);
    EXPECT_EQ(code("uv=all.exr", "all.exr: uv.U: "), 3);
    EXPECT_EQ(code("hit.uv=none.exr", "none.exr"), 3);
    EXPECT_EQ(code("hit.uv=all.exr", "is the input", "all.exr"), 2);
    EXPECT_EQ(file_bytes(folder / "all.exr"), before);
    EXPECT_EQ(folder.count(), 1u);
}

/// A row of the README's table of statistics stands for each field.
TEST_F(Render, StatisticsAreDocumented) {
    ASSERT_EQ(render({"-o", "/dev/null", "--channels", "R,err.kind,certified,certified.pixel",
                      "--touched", "--stats", "stats.json"})
                  .code,
              0);
    const auto stats = nlohmann::json::parse(file_bytes(folder / "stats.json"));
    const std::string readme = file_bytes(QUADREL_SOURCE_DIR "/README.md");
    const std::size_t from = readme.find("## Statistics");
    const std::string section = readme.substr(from, readme.find("\n## ", from) - from);
    const auto is_said = [&](const std::string& field) {
        return section.find("`" + field + "`") != std::string::npos;
    };
    for (const auto& [field, value] : stats.items()) EXPECT_TRUE(is_said(field)) << field;
    for (const char* const part : {"primitives", "maxima"})
        for (const auto& [field, value] : stats[part].items()) EXPECT_TRUE(is_said(field)) << field;
    for (const auto& [field, value] : stats["textures"].at(0).items())
        EXPECT_TRUE(is_said(field)) << field;
    EXPECT_FALSE(is_said("no_such_field"));
}

TEST_F(Render, OutputsThatCannotBeWritten) {
    EXPECT_EQ(render({"-o", "missing/a.exr"}).code, 5);
    EXPECT_EQ(render({"-o", "."}).code, 5);
    EXPECT_EQ(render({"-o", "/proc/a.exr"}).code, 5);
    EXPECT_EQ(render({"-o", "/dev/full"}).code, 5);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
    EXPECT_EQ(render({"-o", "a.png", "--preview", "./a.png"}).code, 2);
    EXPECT_EQ(folder.count(), 0u);
}

/// Killed at some moment, mostly while it renders or writes: the old file or the whole new one
/// is there, and nothing else.
TEST_F(Render, KilledAtAnyMomentLeavesOneWholeFile) {
    ASSERT_EQ(render({"-o", "a.exr"}).code, 0);
    const std::string old = file_bytes(folder / "a.exr");
    const TemporaryFolder logs;
    for (int i = 0; i < 12; ++i) {
        const pid_t child = start({"render", scene, "--size", "200x200", "-o", "a.exr"},
                                  folder.path(), logs.path());
        std::this_thread::sleep_for(std::chrono::milliseconds(15 * i + 20));
        kill(child, SIGTERM);
        const int code = wait_for(child);
        EXPECT_TRUE(code == 143 || code == 0 || code == 1000 + SIGTERM) << code;
        EXPECT_EQ(folder.count(), 1u);
        if (file_bytes(folder / "a.exr") != old) {
            EXPECT_EQ(read_exr(folder / "a.exr").film.window, (Window{0, 0, 200, 200}));
        }
    }
}

}  // namespace
}  // namespace quadrel::cli_tests
