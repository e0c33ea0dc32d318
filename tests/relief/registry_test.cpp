// What holds for every stage of the registry, whatever it computes. A new stage is tested by being
// listed.
#include <algorithm>
#include <set>

#include "effort.hpp"
#include "relief/planted.hpp"
#include "relief/stage_inputs.hpp"

namespace quadrel::test {
namespace {

using Stage = StageUnderTest<float>;

bool is_output(const StageInfo& stage, Value v) {
    return std::find(stage.outputs.begin(), stage.outputs.end(), v) != stage.outputs.end();
}
bool is_input(const StageInfo& stage, Value v) {
    return std::find(stage.inputs.begin(), stage.inputs.end(), v) != stage.inputs.end();
}
void each_value(const std::function<void(Value)>& visit) {
    for (int v = 0; v < static_cast<int>(Value::count); ++v) visit(static_cast<Value>(v));
}
/// Values that a stage changes in place stay as they are.
void poison_outputs(const StageInfo& stage, Batch<float>& batch) {
    for (const Value v : stage.outputs)
        if (!is_input(stage, v)) batch.poison(v);
}

/// `check` for every stage; the first failure, with the stage's id.
testing::AssertionResult for_every_stage(
    const std::function<testing::AssertionResult(const StageInfo&)>& check) {
    for (const StageInfo& stage : all_stages()) {
        const auto result = check(stage);
        if (!result)
            return testing::AssertionFailure() << stage.text.id << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

/// displace with an error that no stage may have.
Stage flawed(Planted planted) {
    const auto change = [planted](Batch<float>& b) {
        for (int lane = 0; lane + 4 < b.lanes; ++lane) {
            float& x = b.real(Value::hit_P, lane);
            if (planted == Planted::neighbour_quad_seen) x = b.real(Value::hit_P, lane + 4);
            if (planted == Planted::rough_result) x *= 1.01f;
        }
        if (planted == Planted::output_missing) b.poison(Value::hit_P);
        if (planted == Planted::undeclared_output) b.poison(Value::N);
    };
    return {"displace", {}, change};
}

// ---- Descriptions -------------------------------------------------------------------------------

testing::AssertionResult is_described(const StageInfo& stage) {
    for (const char* text :
         {stage.text.id, stage.text.room, stage.text.summary, stage.text.source}) {
        if (text == nullptr || *text == 0) return testing::AssertionFailure() << "a text is empty";
    }
    if (stage.outputs.empty()) return testing::AssertionFailure() << "no outputs";
    for (const Value v : stage.outputs) {
        // Clipping changes a status in place, and flags may be added behind the trace; searches
        // over curved surfaces turn the frame.
        const bool frame =
            v == Value::frame_normal || v == Value::T || v == Value::B || v == Value::J;
        const bool in_place =
            v == Value::hit_status || v == Value::hit_flags || (frame && stage.may_miss);
        if (is_input(stage, v) && !in_place)
            return testing::AssertionFailure() << info(v).name << " is both";
    }
    std::set<std::string> names;
    for (const ParameterText& p : stage.parameters) {
        const bool in_range = p.minimum <= p.default_value && p.default_value <= p.maximum;
        if (!in_range || !names.insert(p.name).second) return testing::AssertionFailure() << p.name;
    }
    return testing::AssertionSuccess();
}

TEST(Registry, DescribesEveryStage) {
    EXPECT_TRUE(for_every_stage(is_described));
    StageInfo stage = *find_stage("linear");
    ParameterText steps = stage.parameters[0];
    steps.default_value = 0;
    stage.parameters = {&steps, 1};
    EXPECT_FALSE(is_described(stage));
}

TEST(Registry, IdsAreUniqueAndHaveKernels) {
    std::set<std::string> ids;
    for (const StageInfo& stage : all_stages()) {
        EXPECT_TRUE(ids.insert(stage.text.id).second) << stage.text.id;
        EXPECT_EQ(find_stage(stage.text.id), &stage);
    }
    for (const KernelTable* table : {&scalar_float_kernels(), &scalar_double_kernels()}) {
        std::set<std::string> rows;
        for (const std::string_view id : kernel_ids(*table)) rows.emplace(id);
        EXPECT_EQ(rows, ids);
    }
}

// ---- Outputs ------------------------------------------------------------------------------------

/// Every lane of every declared output, and no lane of any other value.
testing::AssertionResult stores_its_outputs(const StageInfo& info_of, const Stage& stage) {
    StageInputs inputs(1);
    poison_outputs(info_of, inputs.batch);
    Batch<float> given = inputs.batch;
    stage.run(inputs.batch);
    testing::AssertionResult result = testing::AssertionSuccess();
    each_value([&](Value v) {
        const bool output = is_output(info_of, v);
        for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
            for (int c = 0; c < info(v).components; ++c) {
                const bool missing = output && inputs.batch.poisoned(v, lane, c);
                const bool changed =
                    !output && inputs.batch.bits(v, lane, c) != given.bits(v, lane, c);
                if (missing || changed) result = testing::AssertionFailure() << info(v).name;
            }
        }
    });
    return result;
}

TEST(EveryStage, StoresItsOutputsAndNothingElse) {
    EXPECT_TRUE(for_every_stage(
        [](const StageInfo& stage) { return stores_its_outputs(stage, {stage.text.id}); }));
    const StageInfo& displace = *find_stage("displace");
    EXPECT_FALSE(stores_its_outputs(displace, flawed(Planted::output_missing)));
    EXPECT_FALSE(stores_its_outputs(displace, flawed(Planted::undeclared_output)));
}

/// Leaving out any one output changes no bit of the others.
testing::AssertionResult outputs_do_not_depend_on_demand(const StageInfo& stage) {
    StageInputs inputs(2);
    Batch<float> all = inputs.batch;
    all.run(stage.text.id);
    for (const Value left_out : stage.outputs) {
        if (is_input(stage, left_out)) continue;  // someone asks for it: the stage itself
        Batch<float> some = inputs.batch;
        poison_outputs(stage, some);
        some.want(left_out, false);
        some.run(stage.text.id);
        if (!some.poisoned(left_out, 0)) return testing::AssertionFailure() << "stored anyway";
        for (const Value v : stage.outputs) {
            const Value one[] = {v};
            const auto result = same_bits<float>(all, some, one);
            if (v != left_out && !result) return result;
        }
    }
    return testing::AssertionSuccess();
}

TEST(EveryStage, OutputsDoNotDependOnDemand) {
    EXPECT_TRUE(for_every_stage(outputs_do_not_depend_on_demand));
}

// ---- Inputs -------------------------------------------------------------------------------------

/// Values and maps that are not declared have no effect.
testing::AssertionResult reads_only_its_inputs(const StageInfo& stage,
                                               std::span<const Value> declared) {
    StageInputs inputs(3);
    Batch<float> bare = inputs.batch;
    each_value([&](Value v) {
        if (std::find(declared.begin(), declared.end(), v) == declared.end()) bare.poison(v);
    });
    for (int i = 0; i < texture_slot_count; ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        const auto end = stage.textures.end();
        if (std::find(stage.textures.begin(), end, slot) == end) bare.unbind(slot);
    }
    inputs.batch.run(stage.text.id);
    bare.run(stage.text.id);
    return same_bits<float>(inputs.batch, bare, stage.outputs);
}

TEST(EveryStage, ReadsOnlyItsInputs) {
    EXPECT_TRUE(for_every_stage(
        [](const StageInfo& stage) { return reads_only_its_inputs(stage, stage.inputs); }));
    const StageInfo& displace = *find_stage("displace");
    EXPECT_FALSE(reads_only_its_inputs(displace, displace.inputs.subspan(1)));
}

// ---- Lanes --------------------------------------------------------------------------------------

/// Moves every quad of `from` to the place that `place` gives it.
Batch<float> rearranged(Batch<float>& from, const std::function<int(int)>& place) {
    Batch<float> to = from;
    for (int lane = 0; lane < from.lanes; ++lane) {
        const int there = 4 * place(lane / 4) + lane % 4;
        to.active[there] = from.active[lane];
        to.primitive[there] = from.primitive[lane];
        for (int i = 0; i < 3; ++i) to.edges[i][there] = from.edges[i][lane];
        each_value([&](Value v) {
            for (int light = 0; light < (info(v).per_light ? max_lights : 1); ++light) {
                if (info(v).kind == ValueKind::integer) {
                    to.integer(v, there, light) = from.integer(v, lane, light);
                    continue;
                }
                for (int c = 0; c < info(v).components; ++c) {
                    to.real(v, there, c, light) = from.real(v, lane, c, light);
                }
            }
        });
    }
    return to;
}

/// A quad's results have the same bits wherever in the batch it lies, and whatever its neighbours.
testing::AssertionResult quads_are_independent(const StageInfo& info_of, const Stage& stage) {
    StageInputs inputs(4);
    const auto reversed = [](int quad) { return batch_quads - 1 - quad; };
    Batch<float> other = rearranged(inputs.batch, reversed);
    stage.run(inputs.batch);
    stage.run(other);
    Batch<float> back = rearranged(other, reversed);
    return same_bits<float>(inputs.batch, back, info_of.outputs);
}

TEST(EveryStage, QuadsAreIndependent) {
    EXPECT_TRUE(for_every_stage(
        [](const StageInfo& stage) { return quads_are_independent(stage, {stage.text.id}); }));
    EXPECT_FALSE(
        quads_are_independent(*find_stage("displace"), flawed(Planted::neighbour_quad_seen)));
}

/// Inactive quads change no active quad's bits and count no fetches.
testing::AssertionResult inactive_quads_have_no_effect(const StageInfo& stage, bool count_all) {
    StageInputs inputs(5);
    Batch<float> all = inputs.batch, half = inputs.batch, rest = inputs.batch;
    for (Batch<float>* batch : {&all, &half, &rest}) batch->counters = {};
    for (int lane = 0; lane < all.lanes; ++lane) {
        half.active[lane] = lane / 4 % 2;
        rest.active[lane] = !half.active[lane];
    }
    for (Batch<float>* batch : {&all, &half, &rest}) batch->run(stage.text.id);
    for (const Value v : stage.outputs) {
        for (int lane = 0; lane < all.lanes; ++lane) {
            Batch<float>& served = half.active[lane] ? half : rest;
            for (int c = 0; c < info(v).components; ++c) {
                if (served.bits(v, lane, c) == all.bits(v, lane, c)) continue;
                return testing::AssertionFailure() << info(v).name << ", lane " << lane;
            }
        }
    }
    const std::uint64_t counted = half.fetches() + (count_all ? all : rest).fetches();
    return counted == all.fetches() ? testing::AssertionSuccess()
                                    : testing::AssertionFailure() << "fetches";
}

TEST(EveryStage, InactiveQuadsHaveNoEffect) {
    EXPECT_TRUE(for_every_stage(
        [](const StageInfo& stage) { return inactive_quads_have_no_effect(stage, false); }));
    EXPECT_FALSE(inactive_quads_have_no_effect(*find_stage("linear"), true));
}

// ---- Number types -------------------------------------------------------------------------------

/// Stages whose results jump where a comparison turns over: one lane in a hundred may differ.
bool decides(const StageInfo& stage) {
    const std::string id = stage.text.id, room = stage.text.room;
    return room == "shadow" || room == "trace" || id == "lod" || id == "shade-thesis@published";
}

/// How many lanes of `lanes` may differ. thesis-sphere repeats a step that may enlarge differences;
/// leaps of rmq-leap end a number type's own margin above a bound; cones and spheres come near to
/// the surface step by step, and the number of steps to a tolerance may change with a rounding.
int lanes_that_may_differ(const StageInfo& stage, int lanes) {
    const std::string id = stage.text.id;
    const bool creeps = id.find("cone") != std::string::npos || id.find("sphere-") == 0;
    // Hundreds of accumulated steps, the shorter the flatter the view.
    if (id == "steep-constant-xy@published") return lanes / 8;
    // Looks up to 50 world units away, hundreds of tiles.
    if (id == "curved-quadric@published") return lanes / 25;
    if (id == "thesis-sphere" || id == "rmq-leap" || creeps) return lanes / 25;
    return decides(stage) ? lanes / 100 : 0;
}

bool agree(Batch<float>& single, Batch<double>& wide, Value v, int lane) {
    if (info(v).kind == ValueKind::integer) {
        return single.integer(v, lane) == wide.integer(v, lane);
    }
    for (int c = 0; c < info(v).components; ++c) {
        const double a = single.real(v, lane, c), b = wide.real(v, lane, c);
        const bool both_nan = a != a && b != b;
        if (!both_nan && !(a == b) && !(std::abs(a - b) <= 2e-3 * (1 + std::abs(b)))) return false;
    }
    return true;
}

/// Where the view points away from the surface this march ends at its bound of 65536 steps, as in
/// most quads of these inputs: an eighth of the quads takes seconds and shows as much.
void leave_out_long_marches(const StageInfo& stage, Batch<float>& batch) {
    if (std::string(stage.text.id) != "steep-constant-xy@published") return;
    for (int lane = 0; lane < batch.lanes; ++lane)
        if (lane / 4 % 8 != 0) batch.active[lane] = false;
}

testing::AssertionResult number_types_agree(const StageInfo& info_of, const Stage& stage) {
    int lanes = 0;
    std::map<std::string_view, int> differ;
    for (int seed = 10; seed < 14; ++seed) {
        StageInputs inputs(seed);
        leave_out_long_marches(info_of, inputs.batch);
        Batch<double> wide = in_double(inputs.batch);
        stage.run(inputs.batch);
        wide.run(info_of.text.id);
        for (int lane = 0; lane < wide.lanes; ++lane) {
            if (!inputs.batch.active[lane]) continue;
            ++lanes;
            for (const Value v : info_of.outputs)
                differ[info(v).name] += !agree(inputs.batch, wide, v, lane);
        }
    }
    const int allowed = lanes_that_may_differ(info_of, lanes);
    for (const auto& [name, count] : differ) {
        if (count > allowed)
            return testing::AssertionFailure() << name << " of " << count << " lanes";
    }
    return testing::AssertionSuccess();
}

TEST(EveryStage, FloatAndDoubleAgree) {
    int tried = 0;
    EXPECT_TRUE(for_every_stage([&](const StageInfo& stage) {
        return is_tried(tried++) ? number_types_agree(stage, {stage.text.id})
                                 : testing::AssertionSuccess();
    }));
    EXPECT_FALSE(number_types_agree(*find_stage("displace"), flawed(Planted::rough_result)));
}

}  // namespace
}  // namespace quadrel::test
