#include "render/ranges/range_batch.hpp"

#include <algorithm>
#include <limits>

#include "quadrel/num/range/ranged.hpp"

namespace quadrel {
namespace {

constexpr int quad_lanes = 4;
constexpr std::size_t array_bytes = quad_lanes * sizeof(Ranged);

constexpr FragmentRange unknown{-std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity(), 0};

/// What a decision in a stage of that room is about.
std::uint32_t kind_of(const StageInfo& stage) {
    const std::string_view room = stage.text.room;
    return room == "trace" || room == "clip" ? Undecided::hit : Undecided::branch;
}

/// How many stages have run when the last of them has written an array.
std::size_t stages_until_written(const MaterialPlan& plan, int slot) {
    for (std::size_t k = plan.stages.size(); k > 0; --k)
        for (const Value value : plan.stages[k - 1].info->outputs)
            if (slot >= slot_of(value) && slot < slot_of(value) + arrays_of(value)) return k;
    return 0;
}

/// Ranges that meet become one; what is left is disjoint.
FragmentRange joined(std::vector<FragmentRange>& ways) {
    std::ranges::sort(ways, {}, &FragmentRange::low);
    FragmentRange all = ways.front();
    all.paths = 1;
    for (const FragmentRange& way : ways) {
        if (way.low > all.high) ++all.paths;
        all.high = std::max(all.high, way.high);
    }
    return all;
}

}  // namespace

RangeBatch::RangeBatch(const RangePlan& plan)
    : plan_(plan),
      values_(slot_count, nullptr),
      results_(plan.slots.size() * batch_lanes),
      ways_(plan.slots.size()),
      through_(plan.slots.size()),
      undecided_(batch_lanes) {}

void RangeBatch::prepare(const MaterialPlan& plan) {
    if (prepared_ == &plan) return;
    prepared_ = &plan;
    std::size_t arrays = 0;
    for (std::size_t v = 0; v < plan.values.size(); ++v)
        if (plan.values[v]) arrays += static_cast<std::size_t>(arrays_of(static_cast<Value>(v)));
    memory_.assign(arrays * array_bytes, std::byte());
    std::ranges::fill(values_, nullptr);
    std::byte* next = memory_.data();
    for (std::size_t v = 0; v < plan.values.size(); ++v) {
        if (!plan.values[v]) continue;
        const auto value = static_cast<Value>(v);
        for (int i = 0; i < arrays_of(value); ++i, next += array_bytes) {
            values_[static_cast<std::size_t>(slot_of(value) + i)] = next;
            if (info(value).kind == ValueKind::real)
                std::fill_n(reinterpret_cast<Ranged*>(next), quad_lanes, Ranged(0.0, 0.0));
        }
    }
    for (std::size_t s = 0; s < plan_.slots.size(); ++s)
        through_[s] = stages_until_written(plan, plan_.slots[s]);
}

void RangeBatch::run(std::uint32_t material, const StageCall& call, const Batch& drawn,
                     const QuadCoverage* quads, const Geometry& geometry) {
    const MaterialPlan& plan = plan_.materials[material];
    prepare(plan);
    context_ = plan_.table->context();
    context_->budget = plan_.budget;
    context_->maps = plan_.maps;
    material_ = *call.material;
    material_.heights_bounded = 0;
    material_.maxima = nullptr;
    for (int q = 0; q < drawn.quads(); ++q) {
        call_ = call;
        call_.material = &material_;
        call_.counters = nullptr;
        call_.log = nullptr;
        drawn.point_to_quads(call_, geometry, q);
        call_.planes = nullptr;
        call_.values = values_.data();
        call_.lanes = quad_lanes;
        run_quad(plan, q, quads[q]);
    }
}

void RangeBatch::run_stages(const MaterialPlan& plan) {
    context_->begin_run();
    stages_run_ = 0;
    for (const PlannedStage& stage : plan.stages) {
        context_->kind = kind_of(*stage.info);
        call_.parameters = stage.params.data();
        call_.light = stage.light;
        stage.run(&call_);
        if (context_->too_many) return;
        ++stages_run_;
        if (stores(stage, Value::hit_uv)) name_place();
    }
}

/// What reads maps beside the hit reads them at places that move together.
void RangeBatch::name_place() {
    const auto slot = static_cast<std::size_t>(slot_of(Value::hit_uv));
    if (values_[slot] != nullptr && values_[slot + 1] != nullptr)
        plan_.table->name_place(values_[slot], values_[slot + 1]);
}

void RangeBatch::run_quad(const MaterialPlan& plan, int quad, const QuadCoverage& coverage) {
    std::fill_n(context_->undecided, quad_lanes, 0u);
    context_->begin_lane(-1);
    run_stages(plan);
    for (int lane = 0; lane < quad_lanes; ++lane) record(quad, lane);
    if (context_->too_many) return give_up(quad);
    const std::uint32_t several = context_->joined;
    for (int lane = 0; lane < quad_lanes; ++lane)
        if ((several >> lane & 1) != 0 && coverage.samples[static_cast<std::size_t>(lane)] != 0)
            follow(plan, quad, lane);
    for (int lane = 0; lane < quad_lanes; ++lane)
        undecided_[static_cast<std::size_t>(quad_lanes * quad + lane)] = context_->undecided[lane];
}

/// Of what stages write that the last run has not got through, nothing is known.
void RangeBatch::give_up(int quad) {
    for (std::size_t s = 0; s < plan_.slots.size(); ++s)
        for (int lane = 0; through_[s] > stages_run_ && lane < quad_lanes; ++lane)
            result(s, quad_lanes * quad + lane) = unknown;
    for (int lane = 0; lane < quad_lanes; ++lane)
        undecided_[static_cast<std::size_t>(quad_lanes * quad + lane)] = context_->undecided[lane];
}

/// The ranges of a lane that the last run has left.
void RangeBatch::record(int quad, int lane) {
    for (std::size_t s = 0; s < plan_.slots.size(); ++s) {
        FragmentRange range;
        plan_.table->ends(values_[static_cast<std::size_t>(plan_.slots[s])], lane, &range.low,
                          &range.high);
        if (context_->followed < 0)
            result(s, quad_lanes * quad + lane) = range;
        else
            ways_[s].push_back(range);
    }
}

/// One way after another, if they are no more than `most`.
bool RangeBatch::follow_ways(const MaterialPlan& plan, int quad, int lane, int most) {
    for (auto& ways : ways_) ways.clear();
    context_->begin_lane(lane);
    int count = 0;
    do {
        run_stages(plan);
        record(quad, lane);
    } while (!context_->too_many && ++count < most && context_->next_way());
    return !context_->too_many && (count < most || !context_->next_way());
}

/// Where a lane has too many ways, the sides of its decisions are taken together, but for those
/// between constants; where that is too many as well, all are, as they are already.
void RangeBatch::follow(const MaterialPlan& plan, int quad, int lane) {
    bool all = follow_ways(plan, quad, lane, most_ways);
    if (!all) {
        context_->together = true;
        all = follow_ways(plan, quad, lane, most_ways);
        context_->together = false;
    }
    for (std::size_t s = 0; all && s < plan_.slots.size(); ++s)
        result(s, quad_lanes * quad + lane) = joined(ways_[s]);
}

const FragmentRange& RangeBatch::range(const ChannelSource& channel, int lane) const {
    const auto slot = std::ranges::find(plan_.slots, channel.slot()) - plan_.slots.begin();
    return results_[static_cast<std::size_t>(slot) * batch_lanes + static_cast<std::size_t>(lane)];
}

}  // namespace quadrel
