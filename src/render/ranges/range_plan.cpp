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

/// Which stages need not run, since all that is read of them is injected: from the last one back,
/// so that what only such stages read is not read at all.
std::vector<bool> known_stages(const MaterialPlan& plan, const ValueSet& wanted,
                               const InjectedValues* injected) {
    std::vector<bool> known(plan.stages.size(), false);
    ValueSet read = wanted;
    for (std::size_t i = plan.stages.size(); injected != nullptr && i-- > 0;) {
        const PlannedStage& stage = plan.stages[i];
        known[i] = std::ranges::all_of(stage.info->outputs, [&](Value v) {
            return !read[static_cast<std::size_t>(v)] ||
                   (injected->has(v, stage.light) && is_last_to_store(plan, i, v));
        });
        if (known[i]) continue;
        for (const Value v : stage.info->inputs) read.set(static_cast<std::size_t>(v));
    }
    return known;
}

MaterialPlan plan_on_ranges(const Scene& scene, const Material& material, const Wanted& wanted,
                            const RangeTable& table) {
    MaterialPlan plan = plan_material(scene, material, wanted, scalar_double_kernels());
    for (PlannedStage& stage : plan.stages) {
        stage.run = find_kernel(table, stage.info->text.id);
        stage.checks = {};
    }
    return plan;
}

Discarding discarding_of(const Material& material) {
    return {clips(material), material.discard_below};
}

/// Throws UsageError where a stage has no function and is not known either.
void check_runs(const MaterialPlan& plan, const std::vector<bool>& known, const Material& material,
                const std::string& asked) {
    for (std::size_t i = 0; i < plan.stages.size(); ++i)
        if (plan.stages[i].run == nullptr && !known[i])
            throw UsageError(
                fmt::format("channel \"{}\": stage \"{}\" of material \"{}\" does not run on "
                            "ranges (data/limits/README.md says why)",
                            asked, plan.stages[i].info->text.id, material.name));
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
        throw UsageError(fmt::format("channel \"{}\": ranges are of one sample per pixel", asked));
    const bool of_rounding = limits.empty() && std::ranges::all_of(asking, [](const auto& channel) {
                                 return channel.kind == ChannelSource::Kind::undecided;
                             });
    if (set == RangeSet::gpu && limits.empty() && !of_rounding)
        throw UsageError(
            fmt::format("channel \"{}\": expected --limits vulkan, d3d, gl or webgpu", asked));
    if (set == RangeSet::gpu)
        plan.budget = budget_of_limits(of_rounding ? limits_of_rounding : limits);
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
    const bool asks_presence = std::ranges::any_of(asking, [](const ChannelSource& channel) {
        return channel.kind == ChannelSource::Kind::undecided;
    });
    for (const Material& material : scene.materials) {
        plan.discarding.push_back(asks_presence ? discarding_of(material) : Discarding());
        Wanted own = wanted;
        if (plan.discarding.back().by_status)
            own.values.set(static_cast<std::size_t>(Value::hit_status));
        if (plan.discarding.back().below >= 0)
            own.values.set(static_cast<std::size_t>(Value::opacity));
        plan.materials.push_back(plan_on_ranges(scene, material, own, *plan.table));
        plan.known.push_back(known_stages(plan.materials.back(), own.values, injected));
        check_runs(plan.materials.back(), plan.known.back(), material, asked);
        const auto judge = error_judge(scene, material);
        plan.surfaces.push_back(judge && judge->layers == 0 ? std::optional(judge->surface)
                                                            : std::nullopt);
    }
    return plan;
}

}  // namespace quadrel
