// What the registry says of each stage is consistent, and each stage has its kernels.
#include "quadrel/relief/registry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <regex>
#include <set>

#include "built_isas.hpp"
#include "kernels/select.hpp"
#include "quad/planted.hpp"

namespace quadrel::quad_tests {
namespace {

using Stages = std::vector<StageInfo>;
using ValueSet = std::set<Value>;

Stages registry() { return {all_stages().begin(), all_stages().end()}; }

testing::AssertionResult failure(const StageInfo& stage, const std::string& what) {
    return testing::AssertionFailure() << stage.text.id << ": " << what;
}

testing::AssertionResult texts_are_complete(const Stages& stages) {
    const std::regex id("[a-z0-9]+(-[a-z0-9]+)*(@published)?");
    const std::set<std::string> rooms = {"quad",    "frame",      "trace",     "hit",
                                         "surface", "shadow",     "shade",     "depth",
                                         "clip",    "frag-depth", "occlusion", "oracle"};
    std::set<std::string> seen;
    for (const StageInfo& stage : stages) {
        if (!std::regex_match(stage.text.id, id)) return failure(stage, "no proper id");
        if (!seen.insert(stage.text.id).second) return failure(stage, "not the only one");
        if (rooms.count(stage.text.room) == 0) return failure(stage, "unknown room");
        if (std::strlen(stage.text.summary) < 5) return failure(stage, "no summary");
        if (stage.text.source[0] == '\0') return failure(stage, "no source");
        if (stage.number_types.empty() || stage.number_types[0] != "float")
            return failure(stage, "does not run on float");
    }
    return testing::AssertionSuccess();
}

/// A stage's Params as bytes.
class ParamsBytes {
  public:
    explicit ParamsBytes(const StageInfo& stage)
        : size_(stage.params_size), memory_(size_ / sizeof(std::max_align_t) + 1) {
        stage.set_defaults(memory_.data());
    }
    void* data() { return memory_.data(); }
    bool operator==(const ParamsBytes& other) const {
        return std::memcmp(memory_.data(), other.memory_.data(), size_) == 0;
    }

  private:
    std::size_t size_;
    std::vector<std::max_align_t> memory_;
};

/// What means one of a few things, not so many of something, has names for them.
std::string complaint_of_names(const ParameterText& p) {
    const bool counts = p.unit != std::string_view("1");
    if (p.integer && !counts && p.maximum - p.minimum < 6 && value_names(p).empty())
        return "no names for a few values";
    std::set<std::string> names;
    for (const auto& [value, name] : value_names(p)) {
        if (value < p.minimum || value > p.maximum) return "a name for a value out of range";
        if (!names.insert(name).second) return "one name for two values";
        if (name_of_value(p, value) != name) return "two names for one value";
    }
    if (!names.empty() && name_of_value(p, p.default_value).empty())
        return "a default without name";
    return "";
}

std::string complaint(const StageInfo& stage, const ParameterText& p) {
    if (!(p.minimum <= p.default_value && p.default_value <= p.maximum))
        return "default not in range";
    for (const double value : {p.minimum, p.maximum, p.default_value})
        if (p.integer && value != std::floor(value)) return "a fraction for an integer";
    if (std::strlen(p.meaning) < 3 || std::strlen(p.unit) == 0) return "no meaning or unit";
    const ParamsBytes defaults(stage);
    ParamsBytes set(stage);
    p.set(set.data(), p.default_value);
    if (!(set == defaults)) return "another default than the struct's";
    p.set(set.data(), p.default_value == p.minimum ? p.maximum : p.minimum);
    if (set == defaults) return "set does nothing";
    p.set(set.data(), p.default_value);
    if (!(set == defaults)) return "set writes elsewhere";
    return complaint_of_names(p);
}

testing::AssertionResult parameters_are_consistent(const Stages& stages) {
    for (const StageInfo& stage : stages) {
        std::set<std::string> names;
        for (const ParameterText& p : stage.parameters) {
            if (!names.insert(p.name).second) return failure(stage, "two parameters of one name");
            const std::string what = complaint(stage, p);
            if (!what.empty()) return failure(stage, std::string(p.name) + ": " + what);
        }
    }
    return testing::AssertionSuccess();
}

/// Stages that stand for each other: those of a room. Those of quad and displace stand alone.
std::string alternatives_key(const StageInfo& stage) {
    const std::string id = stage.text.id, room = stage.text.room;
    return room == "quad" || id == "displace" ? id : room;
}

/// What every alternative stores.
ValueSet common_outputs(const Stages& stages, const std::string& key) {
    ValueSet common;
    bool first = true;
    for (const StageInfo& stage : stages) {
        if (alternatives_key(stage) != key) continue;
        const ValueSet own(stage.outputs.begin(), stage.outputs.end());
        if (first) common = own;
        std::erase_if(common, [&](Value v) { return own.count(v) == 0; });
        first = false;
    }
    return common;
}

/// In the order of the data flow every input is stored before it is loaded, whichever of the
/// alternatives are chosen.
testing::AssertionResult inputs_are_produced(const Stages& stages) {
    ValueSet stored;
    std::string key;
    for (const StageInfo& stage : stages) {
        if (!key.empty() && alternatives_key(stage) != key)
            stored.merge(common_outputs(stages, key));
        key = alternatives_key(stage);
        for (const Value v : stage.inputs)
            if (stored.count(v) == 0)
                return failure(stage, "nothing stores " + std::string(info(v).name));
    }
    return testing::AssertionSuccess();
}

TEST(Registry, EveryValueIsStoredBySomeStage) {
    ValueSet stored;
    for (const StageInfo& stage : all_stages())
        stored.insert(stage.outputs.begin(), stage.outputs.end());
    EXPECT_EQ(stored.size(), static_cast<std::size_t>(Value::count));
}

TEST(Registry, IsConsistent) {
    EXPECT_TRUE(texts_are_complete(registry()));
    EXPECT_TRUE(parameters_are_consistent(registry()));
    EXPECT_TRUE(inputs_are_produced(registry()));
}

TEST(Registry, FindsItsStages) {
    for (const StageInfo& stage : all_stages()) EXPECT_EQ(find_stage(stage.text.id), &stage);
    EXPECT_EQ(find_stage("frame"), nullptr);
    EXPECT_EQ(find_stage(""), nullptr);
}

struct TwoParams {
    std::int32_t count = 4;
    float share = 0.5f;
};

/// A stage with parameters, to be spoilt.
StageInfo sample_stage(const ParameterText* parameters, std::size_t count) {
    StageInfo stage = registry()[0];
    stage.parameters = {parameters, count};
    stage.params_size = sizeof(TwoParams);
    stage.set_defaults = [](void* params) { *static_cast<TwoParams*>(params) = {}; };
    return stage;
}

testing::AssertionResult parameter_passes(const ParameterText& text) {
    const ParameterText texts[] = {text};
    return parameters_are_consistent({sample_stage(texts, 1)});
}

TEST(Registry, ErrorsInParametersAreNoticed) {
    const ParameterText good = parameter<&TwoParams::count>("count", "1", "how many", 1, 9, 4);
    EXPECT_TRUE(parameter_passes(good));
    EXPECT_TRUE(parameter_passes(parameter<&TwoParams::share>("share", "1", "part", 0, 1, 0.5)));
    ParameterText bad = good;  // default_out_of_range
    bad.maximum = 3;
    EXPECT_FALSE(parameter_passes(bad));
    bad = good;  // other_default
    bad.default_value = 5;
    EXPECT_FALSE(parameter_passes(bad));
    bad = good;  // fraction_for_count
    bad.default_value = 4.5;
    EXPECT_FALSE(parameter_passes(bad));
    bad = good;  // set_does_nothing
    bad.set = [](void*, double) {};
    EXPECT_FALSE(parameter_passes(bad));
}

TEST(Registry, ErrorsInNamesAreNoticed) {
    static constexpr ValueName few[] = {{1, "one"}, {4, "four"}}, twice[] = {{1, "a"}, {4, "a"}},
                               same[] = {{4, "a"}, {4, "b"}}, outside[] = {{3, "a"}, {5, "b"}};
    constexpr auto of = [](const ValueName(&names)[2]) {
        ParameterText text = choice<&TwoParams::count>("count", "how many", names, 4);
        text.maximum = 4;
        text.minimum = 1;
        return text;
    };
    EXPECT_TRUE(parameter_passes(of(few)));
    EXPECT_FALSE(parameter_passes(of(twice)));
    EXPECT_FALSE(parameter_passes(of(same)));
    EXPECT_FALSE(parameter_passes(of(outside)));
    EXPECT_FALSE(parameter_passes(parameter<&TwoParams::count>("count", "1", "which", 1, 5, 4)));
    EXPECT_TRUE(parameter_passes(parameter<&TwoParams::count>("count", "steps", "many", 1, 5, 4)));
}

StageInfo& stage_in(Stages& stages, const std::string& id) {
    return *std::find_if(stages.begin(), stages.end(),
                         [&](const StageInfo& stage) { return stage.text.id == id; });
}

TEST(Registry, ErrorsInTheDataFlowAreNoticed) {
    constexpr auto too_late = values(Value::color);
    constexpr auto fewer = values(Value::T, Value::B);
    Stages stages = registry();  // unproduced_input: without lod nothing needs it, without
                                 // interpolate everything does
    stages.erase(stages.begin());
    EXPECT_FALSE(inputs_are_produced(stages));
    stages = registry();  // produced_too_late
    stage_in(stages, "linear").inputs = too_late;
    EXPECT_FALSE(inputs_are_produced(stages));
    stages = registry();  // alternative_lacks_one
    stage_in(stages, "frame-none").outputs = fewer;
    EXPECT_FALSE(inputs_are_produced(stages));
}

TEST(Registry, ErrorsInTextsAreNoticed) {
    Stages stages = registry();  // equal_ids
    stages.push_back(stages[0]);
    EXPECT_FALSE(texts_are_complete(stages));
    stages = registry();  // unnamed_source
    stages[3].text.source = "";
    EXPECT_FALSE(texts_are_complete(stages));
    stages = registry();
    stages[3].text.id = "Frame_None";
    EXPECT_FALSE(texts_are_complete(stages));
}

/// Judges run on plain numbers, whatever the lanes; what says that there is no proof judges
/// nothing.
bool is_a_judge(const StageInfo& stage) {
    const std::string_view id = stage.text.id;
    return id.find("oracle") != id.npos && id != "oracle-none";
}

testing::AssertionResult has_every_kernel(const KernelTable& table, Stages stages) {
    if (table.isa != std::string_view("scalar")) std::erase_if(stages, is_a_judge);
    std::map<std::string, int> rows;
    for (const std::string_view id : kernel_ids(table)) {
        if (!find_kernel(table, id)) return testing::AssertionFailure() << "a row without function";
        ++rows[std::string(id)];
    }
    for (const StageInfo& stage : stages)
        if (rows[stage.text.id] != 1) return failure(stage, "not exactly one kernel");
    if (rows.size() != stages.size()) return testing::AssertionFailure() << "kernels of no stage";
    if (table.lanes % 4 != 0 || 16 % table.lanes != 0)
        return testing::AssertionFailure() << table.lanes << " lanes";
    return testing::AssertionSuccess();
}

TEST(Kernels, ThereIsOneForEachStage) {
    for (const std::string& isa : built_isas()) {
        const KernelTable& table = select_kernels("float", isa);
        EXPECT_TRUE(has_every_kernel(table, registry())) << isa;
        EXPECT_EQ(table.isa, isa);
        EXPECT_EQ(table.scalar_bytes, 4);
    }
    const KernelTable& in_double = select_kernels("double", "auto");
    EXPECT_TRUE(has_every_kernel(in_double, registry()));
    EXPECT_EQ(in_double.scalar_bytes, 8);
    KernelTable fewer = in_double;  // missing_kernel
    --fewer.count;
    EXPECT_FALSE(has_every_kernel(fewer, registry()));
}

}  // namespace
}  // namespace quadrel::quad_tests
