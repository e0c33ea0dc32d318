// render --task and join: parts of an image, what a killed one leaves, which do not fit together.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>

#include "cli/process.hpp"
#include "film/films.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::cli_tests {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using testing_films::write_bytes;
using Words = std::vector<std::string>;

// Neither side is a multiple of a tile's, and the torus leaves parts empty.
constexpr const char* parts_scene = R"({"quadrel": 1, "size": [70, 300],
    "material": {"shade": "shade-lambert"},
    "objects": [{"mesh": "torus"}]})";

class Parts : public testing::Test {
  protected:
    void SetUp() override { write_bytes(folder / "scene.json", parts_scene); }

    Outcome quadrel(Words words, const Words& more = {}) const {
        words.insert(words.end(), more.begin(), more.end());
        return run(words, folder.path());
    }
    Outcome part(int number, int of, const Words& more = {}) const {
        return quadrel({"render", "scene.json", "-o", "p" + std::to_string(number) + ".exr",
                        "--task", std::to_string(number) + "/" + std::to_string(of)},
                       more);
    }
    void draw_parts(int of, const Words& more = {}) const {
        for (int number = 1; number <= of; ++number)
            EXPECT_EQ(part(number, of, more).code, 0) << number;
    }
    /// Exit code 3, one line with all of `texts`, and no output.
    AssertionResult refuses(const Words& parts, const Words& texts) const {
        Words words{"join", "-o", "joined.exr"};
        words.insert(words.end(), parts.begin(), parts.end());
        const Outcome outcome = run(words, folder.path());
        if (outcome.code != 3) return AssertionFailure() << outcome.code << outcome.err;
        for (const std::string& text : texts)
            if (outcome.err.find(text) == std::string::npos)
                return AssertionFailure() << outcome.err << "without " << text;
        if (std::count(outcome.err.begin(), outcome.err.end(), '\n') != 1)
            return AssertionFailure() << outcome.err;
        return std::filesystem::exists(folder / "joined.exr") ? AssertionFailure() << "output"
                                                              : AssertionSuccess();
    }
    TemporaryFolder folder;
};

TEST_F(Parts, JoinedAreTheFileOfTheWholeRender) {
    const std::vector<Words> kinds = {
        {},
        {"--channels", "R,N,hit.status,id.object", "--compression", "piz", "-D", "samples=4"},
        {"--window", "3,5,61,290", "--tile", "34", "--compression", "rle"},
        {"-D", "conventions=d3d", "--number", "double", "--compression", "none"}};
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        ASSERT_EQ(quadrel({"render", "scene.json", "-o", "whole.exr"}, kinds[kind]).code, 0);
        draw_parts(4, kinds[kind]);
        const Outcome outcome =
            quadrel({"join", "p3.exr", "p1.exr", "p4.exr", "p2.exr", "-o", "joined.exr"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(file_bytes(folder / "joined.exr"), file_bytes(folder / "whole.exr")) << kind;
    }
}

TEST_F(Parts, AreRowsOfTilesThatTileTheImage) {
    draw_parts(5);
    int next = 0;
    for (int number = 1; number <= 5; ++number) {
        const Film film = read_exr(folder / ("p" + std::to_string(number) + ".exr")).film;
        EXPECT_EQ(film.window.y0, next);
        EXPECT_TRUE(film.window.y1 % 64 == 0 || number == 5);
        next = film.window.y1;
    }
    EXPECT_EQ(next, 300);
}

TEST_F(Parts, FinishedOnesAreNotDrawnAgain) {
    draw_parts(2);
    const auto time_of = [&](const char* name) {
        return std::filesystem::last_write_time(folder / name);
    };
    const auto time = time_of("p1.exr");
    const Outcome again = part(1, 2);
    EXPECT_EQ(again.code, 0);
    EXPECT_NE(again.err.find("p1.exr is finished"), std::string::npos) << again.err;
    EXPECT_EQ(time_of("p1.exr"), time);

    // What is there may be of another part, scene, channel, or number type.
    const std::string bytes = file_bytes(folder / "p1.exr");
    const auto is_drawn = [&](int number, int of, const Words& more) {
        write_bytes(folder / ("p" + std::to_string(number) + ".exr"), bytes);
        return part(number, of, more).err.find("is finished") == std::string::npos;
    };
    EXPECT_FALSE(is_drawn(1, 2, {"-t", "1", "--isa", "scalar"}));
    EXPECT_TRUE(is_drawn(2, 2, {}));
    EXPECT_TRUE(is_drawn(1, 3, {}));
    EXPECT_TRUE(is_drawn(1, 2, {"-D", "background=[1,0,0]"}));
    EXPECT_TRUE(is_drawn(1, 2, {"--channels", "Z"}));
    EXPECT_TRUE(is_drawn(1, 2, {"--number", "double"}));
    EXPECT_TRUE(is_drawn(1, 2, {"--preview", "p.png"}));
}

TEST_F(Parts, DamagedOnesAreDrawnAgain) {
    draw_parts(1);
    const std::string good = file_bytes(folder / "p1.exr");
    std::string bad = good;
    bad[bad.size() - 100] = static_cast<char>(bad[bad.size() - 100] ^ 0x55);
    for (const std::string& bytes : {bad, good.substr(0, good.size() - 50)}) {
        write_bytes(folder / "p1.exr", bytes);
        EXPECT_TRUE(refuses({"p1.exr"}, {"p1.exr"}));
        EXPECT_EQ(part(1, 1).code, 0);
        EXPECT_EQ(file_bytes(folder / "p1.exr"), good);
    }
}

TEST_F(Parts, ThatDoNotFitAreRefused) {
    draw_parts(3);
    const auto other = [&](const Words& more) {
        std::filesystem::rename(folder / "p2.exr", folder / "kept.exr");
        EXPECT_EQ(part(2, 3, more).code, 0);
        std::filesystem::rename(folder / "p2.exr", folder / "other.exr");
        std::filesystem::rename(folder / "kept.exr", folder / "p2.exr");
        return Words{"p1.exr", "other.exr", "p3.exr"};
    };
    EXPECT_TRUE(refuses(other({"-D", "background=[1,0,0]"}),
                        {"other.exr", "quadrel:sceneHash", "as in p1.exr"}));
    EXPECT_TRUE(refuses(other({"--number", "double"}),
                        {"quadrel:number", "found double", "expected float as in p1.exr"}));
    EXPECT_TRUE(refuses(other({"--channels", "R,G,B"}), {"other.exr", "channels", "R (float)"}));
    EXPECT_TRUE(refuses(other({"--window", "0,0,70,290"}), {"0,0,70,290"}));
    EXPECT_TRUE(refuses({"p1.exr", "p3.exr"}, {"2 of 3 parts", "2/3 is missing"}));
    EXPECT_TRUE(refuses({"p1.exr", "p2.exr"}, {"3/3 is missing"}));
    EXPECT_TRUE(refuses({"p1.exr", "p2.exr", "p3.exr", "p2.exr"}, {"2/3", "p2.exr"}));
    EXPECT_TRUE(refuses({"p1.exr", "p2.exr", "scene.json"}, {"scene.json"}));
    EXPECT_TRUE(refuses({"p1.exr", "p2.exr", "none.exr"}, {"none.exr"}));
    // Of a long text what differs is said, however far behind, and whose the other one is.
    std::string bytes = file_bytes(folder / "p2.exr");
    const std::size_t at = bytes.find("quadrel:algorithm");
    ASSERT_NE(at, std::string::npos);
    const std::size_t shading = bytes.find("shade-lambert", at);
    ASSERT_LT(shading, bytes.find("quadrel:", at + 1));
    EXPECT_GT(shading - at, 150u) << "not so far behind";
    bytes[shading] = 'S';
    write_bytes(folder / "damaged.exr", bytes);
    EXPECT_TRUE(refuses({"p1.exr", "damaged.exr", "p3.exr"},
                        {"damaged.exr: quadrel:algorithm: found ...", "Shade-lambert",
                         "expected ...", "shade-lambert", " as in p1.exr"}));
    ASSERT_EQ(quadrel({"render", "scene.json", "-o", "whole.exr"}).code, 0);
    EXPECT_TRUE(refuses({"whole.exr"}, {"whole.exr", "found none", "render --task"}));
    // Of another version, which only its file tells.
    ExrFile file = read_exr(folder / "p2.exr");
    std::erase_if(file.attributes,
                  [](const auto& named) { return !named.first.starts_with("quadrel:"); });
    const Attributes attributes = file.attributes;
    file.attributes["quadrel:version"] = "0.0.1";
    write_exr(folder / "old.exr", file.film, file.attributes);
    EXPECT_TRUE(refuses({"p1.exr", "old.exr", "p3.exr"}, {"quadrel:version", "found 0.0.1"}));
    // Rows that are not those of the part that it says it is.
    file.attributes = attributes;
    file.attributes["quadrel:part"] = "3/3";
    write_exr(folder / "moved.exr", file.film, file.attributes);
    EXPECT_TRUE(refuses({"p1.exr", "p2.exr", "moved.exr"}, {"moved.exr", "dataWindow"}));
}

TEST_F(Parts, WrongTasksAreOneLine) {
    for (const auto& [task, text] :
         std::vector<std::pair<std::string, std::string>>{{"0/2", "1 <= I <= N"},
                                                          {"3/2", "1 <= I <= N"},
                                                          {"1", "found \"1\""},
                                                          {"a/b", "I/N"},
                                                          {"1/2 ", "found \"1/2 \""},
                                                          {"1/6", "at most 5 parts"}}) {
        const Outcome outcome = quadrel({"render", "scene.json", "-o", "a.exr", "--task", task});
        EXPECT_EQ(outcome.code, 2) << task;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
    draw_parts(1);
    EXPECT_EQ(quadrel({"join", "p1.exr", "-o", "p1.exr"}).code, 2);
    EXPECT_EQ(quadrel({"join", "p1.exr", "-o", "a.png"}).code, 2);
}

TEST_F(Parts, AKilledOneLeavesNothing) {
    const TemporaryFolder logs;
    // Long enough to be caught at it.
    const pid_t child = start(
        {"render", "scene.json", "-o", "a.exr", "--task", "1/2", "--size", "8192x8192", "-t", "1"},
        folder.path(), logs.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(child, SIGTERM);
    EXPECT_EQ(wait_for(child), 143);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().filename(), "scene.json");
}

/// The bodies of the job scripts, with what their schedulers set.
TEST_F(Parts, JobsOfBothSchedulersMakeTheWhole) {
    const auto job = [&](const std::string& variables, const std::string& script) {
        const std::string line = "cd '" + folder.path().string() +
                                 "' && SCENE=scene.json QUADREL='" QUADREL_EXECUTABLE "' " +
                                 variables + " '" QUADREL_SOURCE_DIR "/bench/jobs/" + script;
        return std::system(line.c_str()) == 0;
    };
    for (const std::string number : {"1", "2", "3"}) {
        EXPECT_TRUE(job("OUT=slurm SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_ID=" + number,
                        "frame_slurm.sh' --channels R --quiet"));
        EXPECT_TRUE(job("OUT=parallel FRAME='--channels R --quiet'",
                        "frame_parallel.sh' " + number + " of 3"));
    }
    ASSERT_EQ(quadrel({"render", "scene.json", "-o", "whole.exr", "--channels", "R"}).code, 0);
    for (const std::string kind : {"slurm", "parallel"}) {
        EXPECT_EQ(quadrel({"join", kind + "/part-1.exr", kind + "/part-2.exr", kind + "/part-3.exr",
                           "-o", kind + ".exr"})
                      .code,
                  0);
        EXPECT_EQ(file_bytes(folder / (kind + ".exr")), file_bytes(folder / "whole.exr")) << kind;
    }
    EXPECT_FALSE(job("OUT=slurm", "frame_slurm.sh' 2>/dev/null"));  // outside of an array
    // A part alone needs to be told how many there are.
    const std::string alone = "OUT=alone SLURM_ARRAY_TASK_COUNT=1 SLURM_ARRAY_TASK_ID=2",
                      script = "frame_slurm.sh' --channels R --quiet";
    EXPECT_FALSE(job(alone, script + " 2>/dev/null"));
    EXPECT_TRUE(job(alone + " PARTS=3", script));
    EXPECT_EQ(file_bytes(folder / "alone/part-2.exr"), file_bytes(folder / "slurm/part-2.exr"));
}

}  // namespace
}  // namespace quadrel::cli_tests
