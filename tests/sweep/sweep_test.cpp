// A whole sweep: what is kept, what is measured again, and what the files say.
#include "sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <set>

#include "file/data_path.hpp"
#include "quadrel/error.hpp"
#include "sweep/plan_files.hpp"
#include "sweep/planted.hpp"
#include "sweep/record.hpp"
#include "sweep/report/page.hpp"
#include "sweep/report/results.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;
using testing_films::file_bytes;
using testing_films::TemporaryFolder;

SweepOutcome run_into(const std::filesystem::path& folder, const Plan& plan, int task = 1,
                      int of = 1) {
    return run_sweep(plan, {folder, task, of, "test", {}});
}

std::set<std::string> keys_of(const std::vector<Json>& records) {
    std::set<std::string> keys;
    for (const Json& record : records) keys.insert(record["key"].get<std::string>());
    return keys;
}

class Sweep : public testing::Test {
  protected:
    TemporaryFolder folder;
    Plan plan = plan_of(folder, small_plan());
    std::filesystem::path out = folder / "out";
};

TEST_F(Sweep, MeasuresTimesCountsAndErrors) {
    const SweepOutcome outcome = run_into(out, plan);
    ASSERT_EQ(outcome.records.size(), 6u);
    EXPECT_EQ(outcome.measured, 6u);
    for (const Json& record : outcome.records) {
        EXPECT_EQ(record.value("failed", ""), "");
        EXPECT_GT(record["draw_ms"].get<double>(), 0);
        EXPECT_GE(record["draw_ms_median"].get<double>(), record["draw_ms"].get<double>());
        EXPECT_GT(record["kernel_ms"].get<double>(), record["trace_ms"].get<double>());
        EXPECT_EQ(record["fragments"].get<int>(), 16 * 16);
        EXPECT_GE(record["lockstep_look_ups"].get<double>(),
                  record["search_look_ups"].get<double>());
        EXPECT_EQ(record["rays"].get<int>(), 16 * 16);
        EXPECT_FALSE(record["machine"].get<std::string>().empty());
    }
}

/// More steps are nearer, and an exact search is exact, but for floats.
TEST_F(Sweep, ErrorsAreThoseOfTheSearch) {
    std::map<std::string, double> texels;
    for (const Json& record : run_into(out, plan).records)
        if (record["view"] == "60")
            texels[record["algorithm"].get<std::string>()] = record["texels_mean"].get<double>();
    EXPECT_GT(texels["linear steps=4"], texels["linear steps=16"]);
    EXPECT_GT(texels["linear steps=16"], 0.003);
    EXPECT_LT(texels["max-mip"], 1e-3);
}

TEST_F(Sweep, FinishedRunsAreNotMeasuredAgain) {
    const SweepOutcome first = run_into(out, plan);
    const SweepOutcome second = run_into(out, plan);
    EXPECT_EQ(second.known, 6u);
    EXPECT_EQ(second.records, first.records);
    // Half a file is no run, and neither is what another one left.
    const std::string key = first.records[2]["key"];
    testing_films::write_bytes(out / "runs" / (key + ".json"), "{\"key\": \"" + key);
    EXPECT_EQ(run_into(out, plan).measured, 1u);
    std::filesystem::remove(out / "runs" / (key + ".json"));
    EXPECT_EQ(run_into(out, plan).measured, 1u);
}

TEST_F(Sweep, WhatChangesARunIsInItsKey) {
    const auto before = keys_of(run_into(out, plan).records);
    for (const auto& change : std::vector<std::function<void(Plan&)>>{
             [](Plan& p) { p.repeats = 2; }, [](Plan& p) { p.wrong_texels = 2; },
             [](Plan& p) { p.maps[0].parameters["one_in"] = 64; }, [](Plan& p) { p.width = 18; },
             [](Plan& p) { p.numbers = {"double"}; },
             [](Plan& p) { p.scenes[0].overrides.emplace_back("material.relief.depth=0.2"); }}) {
        Plan changed = plan;
        change(changed);
        changed.views = {{60.0}};
        for (const std::string& key : keys_of(run_into(out, changed).records))
            EXPECT_FALSE(before.contains(key));
    }
    // Titles and what was published do not.
    Plan renamed = plan;
    renamed.title = "another";
    renamed.algorithms[0].published[60] = 30;
    const SweepOutcome outcome = run_into(out, renamed);
    EXPECT_EQ(outcome.known, 6u);
    EXPECT_EQ(outcome.records[3]["published_fps"].get<double>(), 30);
}

TEST_F(Sweep, PartsJoinedAreTheWhole) {
    const auto whole = keys_of(run_into(out, plan).records);
    for (int task = 1; task <= 4; ++task)
        run_into(folder / ("part" + std::to_string(task)), plan, task, 4);
    const MergedSweeps joined =
        merge_sweeps({folder / "part1", folder / "part2", folder / "part3", folder / "part4"},
                     folder / "joined");
    EXPECT_EQ(joined.lacking, "");
    const std::vector<Json>& merged = joined.records;
    EXPECT_EQ(keys_of(merged), whole);
    for (std::size_t i = 0; i < merged.size(); ++i)
        EXPECT_EQ(merged[i]["order"].get<std::size_t>(), i);
    EXPECT_THROW(merge_sweeps({folder / "nothing"}, folder / "joined"), InputError);
}

/// Why folders are not joined; empty if they are.
std::string refusal(const std::vector<std::filesystem::path>& folders,
                    const std::filesystem::path& to) {
    try {
        merge_sweeps(folders, to);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// Of six runs in four parts the third has the third one alone.
TEST_F(Sweep, PartsThatAreNotAllThereAreNoWhole) {
    std::vector<std::filesystem::path> parts;
    for (int task = 1; task <= 4; ++task) {
        parts.push_back(folder / ("part" + std::to_string(task)));
        run_into(parts.back(), plan, task, 4);
    }
    const std::vector<std::filesystem::path> some{parts[0], parts[1], parts[3]};
    const std::filesystem::path joined = folder / "joined";
    const std::string text = refusal(some, joined);
    EXPECT_NE(text.find("5 of the 6 runs"), std::string::npos) << text;
    EXPECT_NE(text.find("(--task 3/4 lacks 1)"), std::string::npos) << text;
    EXPECT_FALSE(std::filesystem::exists(joined));
    const MergedSweeps partial = merge_sweeps(some, joined, true);
    EXPECT_EQ(partial.records.size(), 5u);
    EXPECT_NE(partial.lacking.find("5 of the 6 runs"), std::string::npos);
    // The rest may come later, into what was joined; a joined folder says itself what it lacks.
    EXPECT_NE(refusal({joined}, folder / "again"), "");
    EXPECT_EQ(merge_sweeps({parts[2]}, joined).records.size(), 6u);
    EXPECT_EQ(refusal({joined}, folder / "again"), "");
    // A part that was killed lacks a run; one of another number of parts is named by none.
    std::filesystem::remove(
        (parts[1] / "runs") /
        (read_records(parts[1] / "runs")[0]["key"].get<std::string>() + ".json"));
    EXPECT_NE(refusal(parts, folder / "other").find("(--task 2/4 lacks 1)"), std::string::npos);
    run_into(folder / "half", plan, 1, 2);
    EXPECT_EQ(refusal({parts[0], folder / "half"}, folder / "other").find("--task"),
              std::string::npos);
    // More parts than runs: a part without any is no part that failed.
    std::vector<std::filesystem::path> many;
    for (int task = 1; task <= 7; ++task) {
        many.push_back(folder / ("many" + std::to_string(task)));
        run_into(many.back(), plan, task, 7);
    }
    EXPECT_EQ(refusal(many, folder / "seven"), "");
    many.pop_back();
    EXPECT_EQ(refusal(many, folder / "six"), "");
}

/// What an earlier plan has left in a folder is neither lacking nor in the place of what is.
TEST_F(Sweep, LeftOversOfAnotherPlanDoNotCount) {
    run_into(folder / "part", plan, 1, 2);
    Plan changed = plan;
    changed.views = {{30.0}, {60.0}};
    run_into(folder / "part", changed, 1, 2);
    EXPECT_NE(refusal({folder / "part"}, folder / "joined").find("3 of the 6 runs"),
              std::string::npos);
    run_into(folder / "rest", changed, 2, 2);
    EXPECT_EQ(refusal({folder / "part", folder / "rest"}, folder / "joined"), "");
}

/// The file that a run's command reads its heights from.
std::filesystem::path heights_in(const Json& record) {
    const std::string command = record["command"];
    const std::string begin = "material.height={\"file\":\"";
    const std::size_t from = command.find(begin) + begin.size();
    return command.substr(from, command.find('"', from) - from);
}

/// Joined, they need no part any more; and joined again from where they have been moved to.
TEST_F(Sweep, CommandsOfAMergedSweepReadItsOwnMaps) {
    run_into(folder / "it's part", plan);
    const std::filesystem::path joined = folder / "joined", again = folder / "again";
    merge_sweeps({folder / "it's part"}, joined);
    std::filesystem::remove_all(folder / "it's part");
    for (const Json& record : read_records(joined / "runs")) {
        EXPECT_EQ(heights_in(record).parent_path(), joined / "maps");
        EXPECT_TRUE(std::filesystem::exists(heights_in(record)));
    }
    for (const Json& record : merge_sweeps({joined}, again).records)
        EXPECT_EQ(heights_in(record).parent_path(), again / "maps");
}

TEST_F(Sweep, ADamagedMapIsMadeAgain) {
    run_into(out, plan);
    const std::filesystem::path map = heights_in(read_records(out / "runs").front());
    const std::string whole = file_bytes(map);
    for (const std::string& damaged : {whole.substr(0, whole.size() / 2), std::string("x")}) {
        testing_films::write_bytes(map, damaged);
        EXPECT_EQ(run_into(out, plan).failed, 0u);
        EXPECT_EQ(file_bytes(map), whole);
    }
}

/// What is wrong with a plan's scene names the plan, and leaves nothing behind.
TEST_F(Sweep, AnErrorOfThePlansSceneIsThePlans) {
    Plan wrong = plan;
    wrong.scenes[0].overrides.emplace_back("material.relief.depthz=1");
    try {
        run_into(out, wrong);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(error.file, plan.file.string());
        EXPECT_EQ(error.key, "scenes[0]");
        EXPECT_NE(std::string(error.what()).find("depthz"), std::string::npos);
    }
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(Sweep, ARunThatCannotBeDrawnSaysWhy) {
    Plan hard = plan;
    hard.isas = {"neon"};
    const SweepOutcome outcome = run_into(out, hard);
    EXPECT_EQ(outcome.failed, 6u);
    EXPECT_NE(outcome.records[0]["failed"].get<std::string>().find("neon"), std::string::npos);
    write_results(out, plan.title, outcome.records);
    EXPECT_TRUE(std::filesystem::exists(out / "page.html"));
}

/// A scene's own map is read at level 0, as the judge reads it: an exact search stays exact however
/// small its texels are in the frame.
TEST_F(Sweep, MipLevelsAreNoErrorsOfTheSearch) {
    Plan own = plan;
    own.scenes = {{"bricks", "bricks-45", {"material.relief.shadow=none"}}};
    own.maps = {scene_map()};
    own.views = {{60.0}, {}};
    own.algorithms = {{"linear", {{"steps", 512}}, {}}, {"max-mip", {}, {}}};
    for (const Json& record : run_into(out, own).records) {
        EXPECT_EQ(record["map_width"].get<int>(), 512);
        EXPECT_LT(record["texels_median"].get<double>(), 0.5) << record["algorithm"];
        EXPECT_NE(record["command"].get<std::string>().find("quadrel render bricks-45 -D "),
                  std::string::npos);
    }
}

TEST_F(Sweep, ADeadFolderIsAnOutputError) {
    testing_films::write_bytes(folder / "file", "x");
    EXPECT_THROW(run_into(folder / "file", plan), OutputError);
}

/// The text of a script element of the page.
Json data_of(const std::string& page, const std::string& id) {
    const std::string begin = "id=\"" + id + "\">";
    const std::size_t from = page.find(begin) + begin.size();
    return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// What the page has is in results.json, with the same values, run by run.
testing::AssertionResult agree(const Json& page, const Json& results) {
    if (page["runs"].size() != results["runs"].size()) return testing::AssertionFailure() << "runs";
    for (std::size_t i = 0; i < page["runs"].size(); ++i)
        for (const auto& [key, value] : page["runs"][i].items())
            if (results["runs"][i].value(key, Json("missing")) != value)
                return testing::AssertionFailure() << key << " of run " << i;
    return testing::AssertionSuccess();
}

TEST_F(Sweep, ThePageHasWhatTheResultsSay) {
    const std::string title = "a </script><b> {{RESULTS}} & \"title\"";
    const SweepOutcome outcome = run_into(out, plan);
    write_results(out, title, outcome.records);
    const std::string page = file_bytes(out / "page.html");
    Json results = Json::parse(file_bytes(out / "results.json"));
    EXPECT_EQ(results["title"], title);
    EXPECT_TRUE(agree(data_of(page, "results-data"), results));
    results["runs"][3]["texels_p99"] = -1;
    EXPECT_FALSE(agree(data_of(page, "results-data"), results))
        << static_cast<int>(Planted::number_changed);
    EXPECT_EQ(data_of(page, "pictures-data").size(), 3u);  // at 60 degrees
    EXPECT_EQ(page.find("{{STYLE}}"), std::string::npos);
    EXPECT_NE(page.find("<title>a &lt;/script>&lt;b> {{RESULTS}} &amp; \"title\"</title>"),
              std::string::npos);
    for (const char* outside : {"https://", "src=\"", "@import", "url("})
        EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST_F(Sweep, TablesHaveALineARun) {
    const SweepOutcome outcome = run_into(out, plan);
    write_results(out, plan.title, outcome.records);
    const std::string csv = file_bytes(out / "results.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    EXPECT_EQ(csv.substr(0, 10), "scene,map,");
    const std::string table = frames_table(outcome.records);
    EXPECT_NE(table.find("| linear steps=4 | spikes 16 | 60 |"), std::string::npos) << table;
    EXPECT_TRUE(std::filesystem::exists(out / "plots" / "front-60-1.svg"));
    EXPECT_TRUE(std::filesystem::exists(out / "plots" / "error-by-angle-1.svg"));
}

/// Machines, instruction sets and builds each have charts of their own.
TEST_F(Sweep, MachinesShareNoAxis) {
    std::vector<Json> records = run_into(out, plan).records;
    const std::size_t one = records.size();
    for (std::size_t i = 0; i < one; ++i) {
        records.push_back(records[i]);
        records.back()["machine"] = "another";
        records.back()["key"] = std::to_string(i);
    }
    write_results(out, plan.title, records);
    EXPECT_TRUE(std::filesystem::exists(out / "plots" / "front-60-2.svg"));
}

}  // namespace
}  // namespace quadrel::sweep_tests
