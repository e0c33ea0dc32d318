// What is no plugin, or no stage that could be planned, is refused with one line and adds nothing.
#include <deque>
#include <fstream>

#include "kernels/select.hpp"
#include "plugin/support.hpp"
#include "quadrel/error.hpp"
#include "stages/stages.hpp"

namespace quadrel::plugin_tests {
namespace {

using Waves = ::plugin_tests::Waves;

struct One : ::plugin_tests::Tilt {
    static constexpr StageText text{"row-one", "surface", "one", "these tests"};
};
struct Other : ::plugin_tests::Tilt {
    static constexpr StageText text{"row-one", "surface", "another", "these tests"};
};

/// Whether loading fails with a message that holds `part`, and leaves the registry as it was.
testing::AssertionResult refused(const std::filesystem::path& file, const std::string& part) {
    const std::size_t before = all_stages().size();
    try {
        load_plugin(file);
    } catch (const InputError& error) {
        const std::string text = error.what();
        if (all_stages().size() != before) return testing::AssertionFailure() << "stages added";
        if (text.find(part) == std::string::npos || text.find('\n') != std::string::npos)
            return testing::AssertionFailure() << text;
        return testing::AssertionSuccess() << text;
    }
    return testing::AssertionFailure() << "loaded";
}

TEST(RefusedPlugin, OfAnotherVersion) {
    EXPECT_TRUE(refused(plugin("quadrel-test-old"), "built for another version of Quadrel"));
}

TEST(RefusedPlugin, WithTheIdOfAnotherStage) {
    EXPECT_TRUE(refused(plugin("quadrel-test-clash"), "stage \"linear\": found the id of another"));
}

TEST(RefusedPlugin, IsMissing) { EXPECT_TRUE(refused(plugin("nothing"), "no such file")); }

TEST(RefusedPlugin, IsAFolder) { EXPECT_TRUE(refused(QUADREL_PLUGINS, "a directory")); }

TEST(RefusedPlugin, IsNoSharedObject) {
    const testing_films::TemporaryFolder folder;
    std::ofstream(folder / "text.so") << "no ELF file";
    EXPECT_TRUE(refused(folder / "text.so", "expected a plugin built by quadrel_add_stages"));
    std::ofstream(folder / "empty.so");
    EXPECT_TRUE(refused(folder / "empty.so", "expected a plugin built by quadrel_add_stages"));
}

TEST(RefusedPlugin, IsASharedObjectOfAnotherKind) {
    const auto oiio = std::filesystem::path(QUADREL_TEST_MODULE_DIR) / "quadrel-oiio.so";
    EXPECT_TRUE(refused(oiio, "a shared object that is no plugin"));
}

TEST(RefusedPlugin, IsAPartOfOne) {
    bool any = false;
    for (const char* isa : {"sse4", "avx2", "avx512", "neon"}) {
        const auto part = plugin(std::string("quadrel-test-stages-") + isa);
        // A part for a set that this CPU lacks cannot be loaded to be asked.
        if (!std::filesystem::exists(part) || !cpu_supports(isa)) continue;
        any = true;
        EXPECT_TRUE(refused(part, std::string("the ") + isa + " part of a plugin"));
    }
    if (!any) GTEST_SKIP() << "no such part was built";
}

TEST(RefusedPlugin, ASoundOneIsNotRefused) {
    EXPECT_FALSE(refused(plugin("quadrel-test-stages"), ""));
}

// ---- Rows ---------------------------------------------------------------------------------------

/// A sound row with an id of its own, changed.
testing::AssertionResult refused_row(const std::function<void(StageRow&)>& change,
                                     const std::string& part) {
    static int count = 0;
    static std::deque<std::string> ids;
    StageRow row = make_stage_row<Waves, Quad<float>>();
    row.text.id = ids.emplace_back("row-" + std::to_string(++count)).c_str();
    change(row);
    const std::size_t before = all_stages().size();
    try {
        static std::deque<StageRow> rows;  // what is added must stay
        register_rows({&rows.emplace_back(row), 1});
    } catch (const UsageError& error) {
        const std::string text = error.what();
        if (all_stages().size() != before) return testing::AssertionFailure() << "a stage added";
        if (text.find(part) == std::string::npos) return testing::AssertionFailure() << text;
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "added";
}

TEST(RefusedRow, ASoundOneIsNotRefused) {
    EXPECT_FALSE(refused_row([](StageRow&) {}, ""));
}

TEST(RefusedRow, Ids) {
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.id = "linear"; }, "the id of another"));
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.id = "none"; }, "another id"));
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.id = ""; }, "without a proper id"));
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.id = "a b"; }, "without a proper id"));
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.source = nullptr; }, "an empty text"));
}

TEST(RefusedRow, Rooms) {
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.room = "quad"; }, "room \"quad\""));
    EXPECT_TRUE(refused_row([](StageRow& row) { row.text.room = "kitchen"; }, "expected one of"));
}

TEST(RefusedRow, ValuesOutOfTheDataFlow) {
    static constexpr Value later[] = {Value::uv, Value::hit_P};
    EXPECT_TRUE(refused_row(
        [](StageRow& row) {
            row.inputs = later;
            row.input_count = 2;
        },
        "found input hit.P, expected a value that is stored before room trace"));
    static constexpr Value foreign[] = {Value::hit_s, Value::color};
    EXPECT_TRUE(refused_row(
        [](StageRow& row) {
            row.outputs = foreign;
            row.output_count = 2;
        },
        "found output color, expected a value that room trace stores"));
    static constexpr Value unknown[] = {static_cast<Value>(1000)};
    EXPECT_TRUE(refused_row([](StageRow& row) { row.inputs = unknown; }, "unknown value"));
    EXPECT_TRUE(refused_row([](StageRow& row) { row.output_count = 0; }, "no outputs"));
}

TEST(RefusedRow, Parameters) {
    static ParameterText parameter = Waves::parameters[0];
    const auto with = [](const auto& change) {
        return [change](StageRow& row) {
            parameter = Waves::parameters[0];
            change(parameter);
            row.parameters = &parameter;
            row.parameter_count = 1;
        };
    };
    EXPECT_TRUE(refused_row(with([](auto& p) { p.default_value = 65; }), "parameter steps"));
    EXPECT_TRUE(refused_row(with([](auto& p) { p.name = "s teps"; }), "parameter s teps"));
    EXPECT_FALSE(refused_row(with([](auto&) {}), ""));
    static ValueName names[] = {{1, "one"}, {12, "twelve"}};
    const auto named = [&](ValueName first) {
        return with([first](auto& p) {
            names[0] = first;
            p.value_names = names;
            p.value_name_count = 2;
        });
    };
    for (const ValueName& wrong : {ValueName{0, "zero"},
                                   {12, "dozen"},
                                   {1, "twelve"},
                                   {1, "1"},
                                   {1, "true"},
                                   {1, ""},
                                   {1, nullptr}})
        EXPECT_TRUE(refused_row(named(wrong), "names of their own"));
    EXPECT_FALSE(refused_row(named({1, "one"}), ""));
}

TEST(RefusedRow, TwiceTheSameId) {
    static StageRow rows[2] = {make_stage_row<Waves, Quad<float>>(),
                               make_stage_row<Waves, Quad<float>>()};
    for (StageRow& row : rows) row.text.id = "row-twice";
    EXPECT_THROW(register_rows(rows), UsageError);
    EXPECT_EQ(find_stage("row-twice"), nullptr);
}

/// Another function under the id of a stage of the program is a clash, the same one is not.
TEST(RefusedRow, AnotherStageOfTheSameId) {
    register_stages<One>();
    EXPECT_NO_THROW(register_stages<One>());
    EXPECT_THROW(register_stages<Other>(), UsageError);
}

}  // namespace
}  // namespace quadrel::plugin_tests
