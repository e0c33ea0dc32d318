#include "render/ranges/range_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "quadrel/error.hpp"
#include "quadrel/relief/rooms.hpp"
#include "render/errors/error_plan.hpp"
#include "render/inject/injected_values.hpp"
#include "render/ranges/limits.hpp"

namespace quadrel {
namespace {

std::uint64_t next_number() {
    static std::atomic<std::uint64_t> number = 0;
    return ++number;
}

void add_slot(RangePlan& plan, int slot) {
    if (std::ranges::count(plan.slots, slot) == 0) plan.slots.push_back(slot);
}

/// Whether all that is read of a stage is injected.
bool is_known(const PlannedStage& stage, const ValueSet& read, const InjectedValues* injected) {
    return injected != nullptr && std::ranges::all_of(stage.info->outputs, [&](Value v) {
               return !read[static_cast<std::size_t>(v)] || injected->has(v, stage.light);
           });
}

MaterialPlan plan_on_ranges(const Scene& scene, const Material& material, const Wanted& wanted,
                            const RangeTable& table, const std::string& asked,
                            const InjectedValues* injected) {
    MaterialPlan plan = plan_material(scene, material, wanted, scalar_double_kernels());
    for (PlannedStage& stage : plan.stages) {
        stage.run = find_kernel(table, stage.info->text.id);
        stage.checks = {};
        if (stage.run == nullptr && !is_known(stage, plan.values, injected))
            throw UsageError(
                fmt::format("channel \"{}\": stage \"{}\" of material \"{}\" does not run on "
                            "ranges: its state is whole numbers, or a map's own texels",
                            asked, stage.info->text.id, material.name));
    }
    return plan;
}

}  // namespace

bool is_range(const ChannelSource& channel) { return channel.range_set != RangeSet::none; }

RangePlan plan_ranges(const Scene& scene, const std::vector<ChannelSource>& channels, RangeSet set,
                      const std::string& limits, const InjectedValues* injected) {
    RangePlan plan;
    std::vector<ChannelSource> asking;
    for (const ChannelSource& channel : channels)
        if (channel.range_set == set) asking.push_back(channel);
    if (asking.empty()) return plan;
    const std::string& asked = asking.front().name;
    if (scene.samples > 1)
        throw UsageError(fmt::format("channel \"{}\": ranges are of one sample a pixel", asked));
    if (set == RangeSet::gpu && limits.empty())
        throw UsageError(
            fmt::format("channel \"{}\": expected --limits vulkan, d3d, gl or webgpu", asked));
    if (set == RangeSet::gpu) plan.budget = budget_of_limits(limits);
    plan.table = &range_kernels();
    plan.maps = next_number();
    plan.certifies = std::ranges::any_of(asking, certifies_pixels);
    Wanted wanted = wanted_values(asking);
    // The judge is a stage of what is drawn.
    for (const Value v : oracle_outputs) wanted.values.reset(static_cast<std::size_t>(v));
    for (const ChannelSource& channel : asking) add_slot(plan, channel.slot());
    if (plan.certifies)
        for (const Value v : {Value::uv, Value::K}) {
            wanted.values.set(static_cast<std::size_t>(v));
            for (int c = 0; c < 2; ++c) add_slot(plan, slot_of(v) + c);
        }
    for (const Material& material : scene.materials) {
        plan.materials.push_back(
            plan_on_ranges(scene, material, wanted, *plan.table, asked, injected));
        const auto judge = error_judge(scene, material);
        plan.surfaces.push_back(judge ? std::optional(judge->surface) : std::nullopt);
    }
    return plan;
}

}  // namespace quadrel
