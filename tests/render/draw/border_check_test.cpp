// What stages store is looked at by rules that are settled with the plan: those that a stage can
// break, and all of them.
#include "render/draw/border_check.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <functional>
#include <limits>

#include "quadrel/relief/registry.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using Settle = std::function<BorderChecks(const PlannedStage&, const ValueSet&)>;

constexpr int lanes = 12;

/// The arrays of a batch, of every value or of all but one; nothing in them is wrong.
class Arrays {
  public:
    explicit Arrays(Value without = Value::count) {
        for (int v = 0; v < static_cast<int>(Value::count); ++v)
            for (int i = 0; i < arrays_of(static_cast<Value>(v)); ++i) {
                const int slot = slot_of(static_cast<Value>(v)) + i;
                words_[slot].fill(std::bit_cast<std::uint32_t>(
                    info(static_cast<Value>(v)).kind == ValueKind::integer ? 0.0f : 0.5f));
                values_[slot] = v == static_cast<int>(without) ? nullptr : words_[slot].data();
            }
    }
    std::uint32_t& at(Value v, int component, int lane) {
        return words_[slot_of(v) + component][lane];
    }
    void* const* values() { return values_; }

  private:
    std::array<std::uint32_t, lanes> words_[slot_count];
    void* values_[slot_count]{};
};

/// Something that no stage may store.
struct Mistake {
    Value value;
    std::uint32_t bits;
    bool forgiven_as_published;
};

constexpr std::uint32_t negative = 0xffffffffu, nan = 0x7fc00000u;
const Mistake mistakes[] = {
    {Value::frame_status, 8, false},
    {Value::hit_status, 8, false},
    {Value::frame_flags, 16, false},
    {Value::hit_flags, 64, false},
    {Value::hit_steps, negative, false},
    {Value::hit_fetches, negative, false},
    {Value::shadow_steps, negative, false},
    {Value::relief_depth, std::bit_cast<std::uint32_t>(-0.5f), true},
    {Value::hit_s, nan, true},
};

PlannedStage planned(const StageInfo& info, const Settle& settle, const ValueSet& values) {
    PlannedStage stage;
    stage.info = &info;
    stage.checks = settle(stage, values);
    return stage;
}

bool as_published(const StageInfo& stage) {
    return std::string_view(stage.text.id).find('@') != std::string_view::npos;
}

/// Each mistake in each lane, by each stage: it is found exactly where the stage could have made
/// it.
testing::AssertionResult finds_what_stages_can_break(const Settle& settle) {
    for (const StageInfo& info : all_stages()) {
        const PlannedStage stage = planned(info, settle, ValueSet().set());
        Arrays arrays;
        if (find_border_fault(stage, arrays.values(), lanes, 4))
            return testing::AssertionFailure() << info.text.id << ": a fault of nothing";
        for (const Mistake& mistake : mistakes)
            for (const int lane : {0, 5, lanes - 1}) {
                Arrays wrong;
                wrong.at(mistake.value, 0, lane) = mistake.bits;
                if (mistake.value == Value::hit_s)
                    wrong.at(Value::hit_status, 0, lane) = static_cast<std::uint32_t>(Status::hit);
                const auto fault = find_border_fault(stage, wrong.values(), lanes, 4);
                const bool expected = stores(stage, mistake.value) &&
                                      !(mistake.forgiven_as_published && as_published(info));
                if (fault.has_value() != expected || (fault && fault->lane != lane))
                    return testing::AssertionFailure()
                           << info.text.id << ", value " << static_cast<int>(mistake.value)
                           << ", lane " << lane;
            }
    }
    return testing::AssertionSuccess();
}

TEST(BorderChecks, FindWhatStagesCanBreak) {
    EXPECT_TRUE(finds_what_stages_can_break(border_checks));
}

TEST(BorderChecks, RulesThatAreLeftOutAreMissed) {
    for (std::size_t rule = 0; rule < BorderChecks().size(); ++rule)
        EXPECT_FALSE(finds_what_stages_can_break([&](const auto& stage, const auto& values) {
            BorderChecks checks = border_checks(stage, values);
            checks.reset(rule);
            return checks;
        })) << rule;
    EXPECT_FALSE(finds_what_stages_can_break([](const auto&, const auto&) {
        return BorderChecks().set();
    })) << "stages blamed for others' values";
}

/// Values that no one asked for have no array, and no rule.
TEST(BorderChecks, ValuesThatAreNotPlannedHaveNone) {
    for (const StageInfo& info : all_stages())
        for (const Mistake& mistake : mistakes) {
            const ValueSet values = ValueSet().set().reset(static_cast<std::size_t>(mistake.value));
            const PlannedStage stage = planned(info, border_checks, values);
            Arrays arrays(mistake.value);
            EXPECT_FALSE(find_border_fault(stage, arrays.values(), lanes, 4)) << info.text.id;
        }
    const PlannedStage shade =
        planned(*find_stage("shade-texture"), border_checks, ValueSet().set());
    EXPECT_TRUE(shade.checks.none()) << "nothing that it stores has a rule";
}

/// Plans come with them, those for counting steps with more.
TEST(BorderChecks, AreSettledWithThePlan) {
    const Scene scene = varied_scene();
    RenderOptions options;
    const RenderPlan plan = plan_render(scene, options, select_kernels(options)).plan;
    const RenderPlan counting = plan_with_steps(plan);
    std::size_t checks[2] = {};
    for (int i = 0; i < 2; ++i)
        for (const MaterialPlan& material : (i == 0 ? plan : counting).materials)
            for (const PlannedStage& stage : material.stages) {
                EXPECT_EQ(stage.checks, border_checks(stage, material.values));
                checks[i] += stage.checks.count();
            }
    EXPECT_GT(checks[0], 0u);
    EXPECT_GT(checks[1], checks[0]);
}

}  // namespace
}  // namespace quadrel::render_tests
