#include "render/exact/exact_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quadrel/error.hpp"
#include "render/exact/observed.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

StageFunction function_on_duals(const char* id) {
    if (const StageFunction run = find_kernel(dual_kernels(), id)) return run;
    return find_added_kernel(dual_kernels(), id);
}

}  // namespace

std::vector<Value> differentiated(const ChannelSource& channel) {
    if (channel.observed != Observed::none) {
        const std::span<const Value> inputs = inputs_of(channel.observed);
        return {inputs.begin(), inputs.end()};
    }
    const bool level = channel.value == Value::lod_rho || channel.value == Value::lod_lambda;
    return {level ? Value::uv : channel.value};
}

bool is_exact(const ChannelSource& channel) {
    return channel.kind == ChannelSource::Kind::exact ||
           channel.kind == ChannelSource::Kind::exact_error;
}

MaterialPlan plan_on_duals(const Scene& scene, const Material& material,
                           const std::vector<Value>& wanted, const std::string& asked) {
    ValueSet values;
    for (const Value v : wanted) values.set(static_cast<std::size_t>(v));
    MaterialPlan plan = plan_material(scene, material, {values, {}}, scalar_double_kernels());
    for (PlannedStage& stage : plan.stages) {
        stage.run = function_on_duals(stage.info->text.id);
        stage.checks = {};  // the stages that are drawn are looked at
        if (stage.run == nullptr)
            throw UsageError(
                fmt::format("{}: stage \"{}\" of material \"{}\" does not run on dual numbers; "
                            "\"number_types\" "
                            "of `quadrel list algorithms --json` says which do",
                            asked, stage.info->text.id, material.name));
    }
    return plan;
}

std::vector<MaterialPlan> plan_exact(const Scene& scene,
                                     const std::vector<ChannelSource>& channels) {
    std::vector<MaterialPlan> plans;
    std::vector<Value> wanted;
    for (const ChannelSource& channel : channels) {
        if (!is_exact(channel)) continue;
        const std::size_t before = wanted.size();
        for (const Value value : differentiated(channel))
            if (std::ranges::count(wanted, value) == 0) wanted.push_back(value);
        if (wanted.size() == before) continue;
        plans.clear();
        for (const Material& material : scene.materials)
            plans.push_back(plan_on_duals(scene, material, wanted,
                                          fmt::format("channel \"{}\"", channel.name)));
    }
    return plans;
}

}  // namespace quadrel
