// Plans: what they ask for, and what is said of wrong ones.
#include "sweep/plan/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "quadrel/error.hpp"
#include "quadrel/relief/registry.hpp"
#include "sweep/plan/families.hpp"
#include "sweep/plan/runs.hpp"
#include "sweep/plan_files.hpp"
#include "sweep/planted.hpp"
#include "sweep/run_scenes.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;
using testing_films::TemporaryFolder;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

TEST(Plan, ListsMultiply) {
    const TemporaryFolder folder;
    const Plan plan = plan_of(
        folder,
        replaced(small_plan(), R"({"kind": "spikes", "size": 16})",
                 R"({"kind": "walls", "size": [16, 32], "direction": [0, 1, 3]}, "scene")"));
    EXPECT_EQ(plan.maps.size(), 7u);
    EXPECT_EQ(plan.maps[0].name, "walls");
    EXPECT_EQ(plan.maps[5].name, "walls direction=3");
    EXPECT_EQ(plan.algorithms.size(), 3u);
    EXPECT_EQ(plan.algorithms[1].name(), "linear steps=16");
    EXPECT_EQ(runs_of(plan).size(), 7u * 2 * 3);
}

/// A group of rows is what its name says, whatever else is asked for.
TEST(Plan, GroupsOfRowsMayHoldWhatIsNamedBesideThem) {
    const TemporaryFolder folder;
    const auto named = [&](const std::string& algorithms) {
        std::vector<std::string> names;
        for (const Algorithm& algorithm :
             plan_of(folder, replaced(small_plan(), R"("max-mip")", algorithms)).algorithms)
            names.push_back(algorithm.name());
        return names;
    };
    const std::vector<std::string> rows = named(R"({"rows": "oracles"}, {"rows": "oracles"})");
    EXPECT_EQ(rows.size(), 2 + trace_rows(Rows::oracles).size());
    EXPECT_EQ(named(R"({"rows": "oracles"}, "oracle-bilinear")"), rows);
    EXPECT_EQ(std::ranges::count(named(R"({"rows": "oracles"}, {"rows": "all"})"), rows.back()), 1);
    // The row of the group has these steps: it is the same search, by the name that was given.
    const std::vector<std::string> all =
        named(R"({"rows": "corrected"}, {"trace": "linear", "parameters": {"steps": 128}})");
    EXPECT_EQ(std::ranges::count(all, "linear"), 0);
    EXPECT_EQ(std::ranges::count(all, "linear steps=128"), 1);
}

/// Every trace of heights whose rays are straight, each once, and the ladder beside the row of the
/// same id.
testing::AssertionResult has_every_row(const std::vector<Algorithm>& algorithms) {
    std::multiset<std::string> named;
    for (const Algorithm& algorithm : algorithms) named.insert(algorithm.name());
    for (const StageInfo& stage : all_stages()) {
        const std::string_view id = stage.text.id;
        const bool is_straight =
            family_of(id) != "layer" && (!stage.may_miss || id == "relief-prewarp");
        if (std::string_view(stage.text.room) == "trace" && is_straight &&
            named.count(stage.text.id) != 1)
            return testing::AssertionFailure() << id;
    }
    return testing::AssertionSuccess();
}

TEST(Plan, EverythingIsEverything) {
    Plan plan = read_plan(QUADREL_SOURCE_DIR "/bench/plans/everything.json");
    EXPECT_TRUE(has_every_row(plan.algorithms));
    std::set<double> angles;
    for (const View& view : plan.views) angles.insert(view.angle.value());
    EXPECT_EQ(angles.size(), 5u);
    plan.algorithms.erase(plan.algorithms.begin() + 20);
    EXPECT_FALSE(has_every_row(plan.algorithms)) << static_cast<int>(Planted::row_left_out);
}

TEST(Plan, AllThatComeWithQuadrelCanBeRead) {
    for (const char* name : {"quick", "everything", "front", "table1", "claims", "mcguire"})
        EXPECT_FALSE(
            runs_of(read_plan(QUADREL_SOURCE_DIR "/bench/plans/" + std::string(name) + ".json"))
                .empty())
            << name;
}

TEST(Plan, TheThesisTableHasTwelveRowsAndTwoReadingsOfCones) {
    const Plan plan = read_plan(QUADREL_SOURCE_DIR "/bench/plans/table1.json");
    std::size_t published = 0;
    for (const Algorithm& algorithm : plan.algorithms) published += algorithm.published.size();
    EXPECT_EQ(published, 12u + 2u);
}

TEST(Plan, CorrectedRowsHaveNoDefects) {
    for (const std::string& id : trace_rows(Rows::corrected)) {
        EXPECT_EQ(id.find("@published"), std::string::npos);
        EXPECT_TRUE(find_stage(id)->not_reproduced.empty()) << id;
        EXPECT_NE(family_of(id), "engine");
    }
    const std::size_t parts = trace_rows(Rows::corrected).size() +
                              trace_rows(Rows::published).size() +
                              trace_rows(Rows::engines).size() + trace_rows(Rows::oracles).size();
    EXPECT_EQ(parts + 1, trace_rows(Rows::all).size());  // and trace-none
}

struct WrongPlan {
    const char *what, *with;
    const char *key, *message;
};

constexpr WrongPlan wrong_plans[] = {
    {R"("sweep": 1)", R"("sweep": 2)", "sweep", "an integer in [1, 1]"},
    {R"("sweep": 1, )", R"()", "scenes", "\"sweep\": 1"},
    {R"("views")", R"("vews")", "vews", "\"views\""},
    {R"("views": [0, 60],)", "", "", "no \"views\""},
    {R"("views": [0, 60])", R"("views": [0, 95])", "views[1]", "[0, 89.5]"},
    {R"("views": [0, 60])", R"("views": ["camra"])", "views[0]", "\"camera\""},
    {R"("views": [0, 60])", R"("views": [])", "views", "an empty array"},
    {R"("max-mip")", R"("max-mp")", "algorithms[1]", "\"max-mip\""},
    {R"("max-mip")", R"("frame-gram")", "algorithms[1]", "a trace"},
    {R"("max-mip")", R"({"rows": "al"})", "algorithms[1].rows", "\"all\""},
    {R"("steps": [4, 16])", R"("stps": 4)", "algorithms[0].parameters.stps", "\"steps\""},
    {R"("steps": [4, 16])", R"("steps": 0)", "algorithms[0].parameters.steps", "[1, 65536]"},
    {R"("steps": [4, 16])", R"("steps": {})", "algorithms[0].parameters.steps", "a number"},
    {R"("kind": "spikes")", R"("kind": "spike")", "maps[0].kind", "\"spikes\""},
    {R"("kind": "spikes")", R"("knd": "spikes")", "maps[0]", "neither \"kind\" nor \"file\""},
    {R"("kind": "spikes")", R"("kind": "spikes", "pitch": 3)", "maps[0].pitch", "does not take"},
    {R"("kind": "spikes", "size": 16)", R"("file": "none.exr")", "maps[0].file", "no such file"},
    {R"("size": 16)", R"("size": 100000)", "maps[0].size", "[8, 4096]"},
    {R"("size": [16, 16])", R"("size": 16)", "size", "an array of 2"},
    {R"("repeats": 1)", R"("repeats": 0)", "repeats", "[1, 1000]"},
    {R"("repeats": 1)", R"("isa": "avx1024")", "isa", "one of"},
    {R"("repeats": 1)", R"("numbers": ["float", "half"])", "numbers[1]", "one of"},
    {R"("side": 16)", R"("side": 1)", "pictures.side", "[16, 256]"},
    {R"("repeats": 1)", R"("maps": [])", "maps", "second time"},
    {R"("views": [0, 60])", R"("views": [0, 60, 0.0])", "views[2]", "each value once"},
    {R"("steps": [4, 16])", R"("steps": [4, 4])", "algorithms[0].parameters.steps[1]", "once"},
    {R"("repeats": 1)", R"("threads": [1, 2, 1])", "threads[2]", "each value once"},
    {R"("side": 16)", R"("angles": [60, 75])", "pictures.angles", "one of the views 0, 60"},
    {R"("max-mip")", R"("max-mip", "max-mip")", "algorithms[2]", "max-mip a second time"},
    {R"("max-mip")", R"({"trace": "linear", "parameters": {"steps": 16}})", "algorithms[1]",
     "algorithms[0] has linear steps=16"},
    {R"("max-mip")", R"("linear", {"trace": "linear", "parameters": {"steps": 128}})",
     "algorithms[2]", "algorithms[1] has linear"},  // its default
    {R"("trace": "linear")", R"("trace": "linear", "published": {"45": 3})", "algorithms",
     "one of the views 0, 60"},
    {R"("trace": "linear")", R"("trace": "linear", "published": {"60": 3, "60.0": 4})",
     "algorithms[0].published.60.0", "each once"},
};

TEST(Plan, WrongOnesAreRefusedInOneLine) {
    const TemporaryFolder folder;
    for (const WrongPlan& wrong : wrong_plans) {
        try {
            plan_of(folder, replaced(small_plan(), wrong.what, wrong.with));
            ADD_FAILURE() << "accepted: " << wrong.with;
        } catch (const InputError& error) {
            const std::string text = error.what();
            EXPECT_EQ(error.key, wrong.key) << text;
            EXPECT_NE(text.find(wrong.message), std::string::npos) << text;
            EXPECT_NE(text.find("plan.json"), std::string::npos) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        }
    }
}

/// [1, 2, ... last], in so many parts of 1.
std::string list_up_to(int last, int parts = 1) {
    std::string list = "[";
    for (int k = 1; k <= last; ++k)
        list += fmt::format("{}{}", k == 1 ? "" : ", ", double(k) / parts);
    return list + "]";
}

TEST(Plan, TooManyRunsAreRefused) {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) -> std::string {
        try {
            plan_of(folder, text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    const std::string pom = fmt::format(
        R"({{"trace": "pom", "parameters": {{"steps_grazing": {0}, "steps_normal": {0}}}}})",
        list_up_to(101));
    EXPECT_NE(refusal(replaced(small_plan(), R"("max-mip")", pom)).find("10000 combinations"),
              std::string::npos);
    const std::string steps = "\"steps\": " + list_up_to(1001);
    const std::string many = replaced(small_plan(), R"("steps": [4, 16])", steps);
    EXPECT_EQ(refusal(many), "accepted");
    const std::string views = "\"views\": " + list_up_to(1000, 20);
    EXPECT_NE(refusal(replaced(many, R"("views": [0, 60])", views)).find("1000000"),
              std::string::npos);
}

TEST(Plan, NamesThatMeanTwoThingsAreRefused) {
    const TemporaryFolder folder;
    const std::string twice = R"({"kind": "spikes", "size": 16, "name": "a"},
        {"kind": "noise", "size": 16, "name": "a"})";
    EXPECT_THROW(
        plan_of(folder, replaced(small_plan(), R"({"kind": "spikes", "size": 16})", twice)),
        InputError);
}

/// Each run of a plan in one of the tasks, once.
testing::AssertionResult share_out(const std::vector<Run>& all,
                                   const std::vector<std::vector<Run>>& tasks) {
    std::map<std::array<std::size_t, 3>, int> seen;
    for (const auto& task : tasks)
        for (const Run& run : task) ++seen[{run.map, run.view, run.algorithm}];
    if (seen.size() != all.size()) return testing::AssertionFailure() << seen.size();
    for (const auto& [run, times] : seen)
        if (times != 1) return testing::AssertionFailure() << times << " times";
    return testing::AssertionSuccess();
}

TEST(Plan, TasksShareTheRunsOut) {
    const TemporaryFolder folder;
    const auto all = runs_of(plan_of(folder, small_plan()));
    for (const int of : {1, 2, 4, 6, 9}) {
        std::vector<std::vector<sweep::Run>> tasks;
        for (int task = 1; task <= of; ++task) tasks.push_back(runs_of_task(all, task, of));
        EXPECT_TRUE(share_out(all, tasks)) << of;
        if (of == 1) continue;
        tasks[0] = tasks[1];
        EXPECT_FALSE(share_out(all, tasks)) << static_cast<int>(Planted::task_off_by_one);
    }
}

}  // namespace
}  // namespace quadrel::sweep_tests
