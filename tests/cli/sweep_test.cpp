// quadrel sweep and advise as commands: plans, jobs of a cluster, what a killed one leaves.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/process.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {
namespace {

using testing_films::file_bytes;
using testing_films::TemporaryFolder;
using Words = std::vector<std::string>;

constexpr const char* plan = R"({"sweep": 1,
    "scenes": [{"name": "clay", "scene": "rows/linear", "set": {
      "material.color": null, "material.shade": "shade-lambert", "material.relief.shadow": "none"}}],
    "maps": [{"kind": "spikes", "size": 16}], "views": [0, 45, 70],
    "algorithms": [{"trace": "linear", "parameters": {"steps": [4, 8, 16]}}, "max-mip"],
    "size": [16, 16], "repeats": 1, "pictures": {"most": 2, "side": 16}})";

/// Names of the runs that a folder has.
std::set<std::string> runs_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "runs"))
        names.insert(entry.path().filename());
    return names;
}

class SweepCommand : public testing::Test {
  protected:
    void SetUp() override { testing_films::write_bytes(folder / "plan.json", plan); }
    Outcome sweep(const Words& more) const {
        Words words{"sweep"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words, folder.path());
    }
    /// The body of a job script, with what its scheduler sets.
    bool job(const std::string& variables, const std::string& script,
             const std::string& out) const {
        const std::string line = "cd '" + folder.path().string() +
                                 "' && PLAN=plan.json QUADREL='" QUADREL_EXECUTABLE "' OUT=" + out +
                                 " " + variables + " '" QUADREL_SOURCE_DIR "/bench/jobs/" + script;
        return std::system(line.c_str()) == 0;
    }
    TemporaryFolder folder;
};

TEST_F(SweepCommand, TheQuickPlanGivesAllFiles) {
    const Outcome outcome =
        sweep({QUADREL_SOURCE_DIR "/bench/plans/quick.json", "-o", "out", "--table"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("| max-mip | bricks 64 | 60 |"), std::string::npos) << outcome.out;
    for (const char* file : {"results.csv", "results.json", "page.html", "plots/front-60-1.svg"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / file)) << file;
    EXPECT_EQ(runs_in(folder / "out").size(), 48u);
}

TEST_F(SweepCommand, ThePlanIsNoOutput) {
    for (const char* name : {"results.json", "results.csv", "page.html", "part.json"}) {
        testing_films::write_bytes(folder / name, plan);
        const Outcome outcome = sweep({name, "-o", "."});
        EXPECT_EQ(outcome.code, 2) << name;
        EXPECT_EQ(file_bytes(folder / name), plan) << name;
    }
}

TEST_F(SweepCommand, ASweepOfWhichNothingCanBeMeasuredIsNone) {
    std::string bad = plan;
    const std::string from = "\"material.relief.shadow\": \"none\"";
    bad.replace(bad.find(from), from.size(), "\"material.relief.depthz\": 1");
    testing_films::write_bytes(folder / "bad.json", bad);
    const Outcome outcome = sweep({"bad.json", "-o", "out"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.err.find("depthz"), std::string::npos) << outcome.err;
}

TEST_F(SweepCommand, JobsOfBothSchedulersMakeTheWhole) {
    ASSERT_EQ(sweep({"plan.json", "-o", "whole", "--quiet"}).code, 0);
    for (const char* task : {"1", "2", "3"}) {
        const std::string number = task;
        EXPECT_TRUE(
            job("SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_ID=" + number, "slurm.sh'", "slurm"));
        EXPECT_TRUE(job("", "parallel.sh' " + number + " of 3", "parallel"));
    }
    for (const std::string kind : {"slurm", "parallel"}) {
        const Outcome outcome =
            sweep({"--merge", kind + "/part-1", kind + "/part-2", kind + "/part-3", "-o", kind});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(runs_in(folder / kind), runs_in(folder / "whole"));
        EXPECT_LT(runs_in(folder / kind / "part-2").size(), runs_in(folder / "whole").size());
    }
    EXPECT_FALSE(job("", "slurm.sh' 2>/dev/null", "slurm"));  // outside of an array
}

/// A part that was lost is submitted again by itself: an array of one or some of the parts.
TEST_F(SweepCommand, ALostPartIsRunAgainAlone) {
    for (const char* task : {"1", "3"})
        EXPECT_TRUE(job("SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_ID=" + std::string(task),
                        "slurm.sh'", "out"));
    const Words parts{"--merge", "out/part-1", "out/part-3", "-o", "joined"};
    const Outcome refused = sweep(parts);
    EXPECT_EQ(refused.code, 3);
    EXPECT_NE(refused.err.find("(--task 2/3 lacks 4)"), std::string::npos) << refused.err;
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "joined"));
    Words partial = parts;
    partial.emplace_back("--partial");
    const Outcome some = sweep(partial);
    EXPECT_EQ(some.code, 0) << some.err;
    EXPECT_NE(some.err.find("warning: joined 8 of the 12 runs"), std::string::npos) << some.err;
    EXPECT_NE(file_bytes(folder / "joined" / "page.html").find("incomplete: 8 of the 12 runs"),
              std::string::npos);
    for (const char* array : {"SLURM_ARRAY_TASK_COUNT=1",
                              "SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=2 "
                              "SLURM_ARRAY_TASK_MAX=3"}) {
        const std::string lost = "SLURM_ARRAY_TASK_ID=2 " + std::string(array);
        EXPECT_FALSE(job(lost, "slurm.sh' 2>/dev/null", "lost")) << array;
        EXPECT_FALSE(std::filesystem::exists(folder / "lost")) << array;
        EXPECT_TRUE(job(lost + " PARTS=3", "slurm.sh'", "out")) << array;
    }
    Words all = parts;
    all.insert(all.begin() + 2, "out/part-2");
    const Outcome whole = sweep(all);
    EXPECT_EQ(whole.code, 0) << whole.err;
    EXPECT_EQ(runs_in(folder / "joined").size(), 12u);
    EXPECT_EQ(file_bytes(folder / "joined" / "page.html").find("incomplete"), std::string::npos);
}

TEST_F(SweepCommand, AKilledOneIsResumed) {
    const TemporaryFolder logs;
    const pid_t child = start({"sweep", "plan.json", "-o", "out"}, folder.path(), logs.path());
    for (int i = 0; i < 2000 && (!std::filesystem::exists(folder / "out" / "runs") ||
                                 runs_in(folder / "out").size() < 3);
         ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, SIGKILL);
    wait_for(child);
    for (const std::string& name : runs_in(folder / "out")) {
        if (!name.ends_with(".json")) continue;  // what was being written
        EXPECT_TRUE(file_bytes(folder / "out" / "runs" / name).ends_with("}\n")) << name;
    }
    const Outcome outcome = sweep({"plan.json", "-o", "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find(" 0 known"), std::string::npos) << outcome.err;
    EXPECT_EQ(runs_in(folder / "out").size(), 12u);  // and no temporary
    EXPECT_NE(sweep({"plan.json", "-o", "out"}).err.find("0 runs measured, 12 known"),
              std::string::npos);
}

TEST_F(SweepCommand, WrongCommandLinesAreOneLine) {
    testing_films::write_bytes(folder / "file", "");
    for (const auto& [words, code, part] : std::vector<std::tuple<Words, int, std::string>>{
             {{"-o", "out"}, 2, "expected one or --merge"},
             {{"plan.json", "--merge", "a", "-o", "out"}, 2, "expected one of them"},
             {{"plan.json", "-o", "out", "--task", "3/2"}, 2, "1 <= I <= N"},
             {{"plan.json", "-o", "out", "--task", "0/2"}, 2, "1 <= I <= N"},
             {{"plan.json", "-o", "out", "--task", "1"}, 2, "found \"1\""},
             {{"none.json", "-o", "out"}, 3, "none.json: found no such file"},
             {{"--merge", "none", "-o", "out"}, 3, "none/runs"},
             {{"plan.json", "--partial", "-o", "out"}, 2, "--partial with a plan"},
             {{"plan.json", "-o", "file"}, 5, "file"}}) {
        const Outcome outcome = sweep(words);
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

TEST_F(SweepCommand, AdviceIsATable) {
    const Outcome outcome =
        run({"advise", "rows/linear", "--error", "2texels", "--angles", "0,45", "--side", "16"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\nCheapest: "), std::string::npos) << outcome.out;
    const Outcome json = run({"advise", "rows/linear", "--error", "2texels", "--angles", "0,45",
                              "--side", "16", "--json"});
    const auto advice = nlohmann::json::parse(json.out);
    EXPECT_NE(outcome.out.find("\nCheapest: " + advice["cheapest"].get<std::string>() + "."),
              std::string::npos);
    EXPECT_EQ(run({"advise", "rows/linear", "--error", "x"}).code, 2);
    EXPECT_EQ(run({"advise", "rows/linear", "--angles", "0..91"}).code, 2);
    EXPECT_EQ(run({"advise", "none"}).code, 3);
}

}  // namespace
}  // namespace quadrel::cli_tests
