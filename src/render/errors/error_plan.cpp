#include "render/errors/error_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "quadrel/relief/rooms.hpp"
#include "quadrel/relief/shadow/light_ray.hpp"
#include "quadrel/relief/trace/layer/stages.hpp"
#include "render/draw/shell.hpp"
#include "render/registry/added_stages.hpp"
#include "render/registry/is_listed.hpp"
#include "render/registry/judged_search.hpp"

namespace quadrel {
namespace {

constexpr const char* exact_frame = "frame-face";
constexpr std::string_view oracle_prefix = "oracle-";

bool reads_slot(const PlannedStage& stage, TextureSlot slot) {
    return std::ranges::count(stage.info->textures, slot) > 0;
}

const PlannedStage* stage_of_room(const std::vector<PlannedStage>& stages, std::string_view room) {
    const auto found = std::ranges::find_if(
        stages, [&](const PlannedStage& stage) { return room == stage.info->text.room; });
    return found == stages.end() ? nullptr : &*found;
}

/// The surface of an oracle-* trace.
oracle::Surface surface_of(std::string_view trace) {
    for (const ValueName& name : oracle::surface_names)
        if (trace.substr(oracle_prefix.size()) == name.name)
            return static_cast<oracle::Surface>(static_cast<int>(name.value));
    return oracle::Surface::bilinear;
}

const char* name_of(oracle::Surface surface) {
    return oracle::surface_names[static_cast<int>(surface)].name;
}

/// Searches of a front and a back; any other of layers takes two of each.
using SearchesOfOneSolid = StageList<DualDepth, DualDepthPublished, DualDepthExact>;

/// The judge of searches of layers. Nothing proves it: what it finds is right up to rounding.
ErrorJudge layer_judge(std::string_view trace) {
    const bool one = is_listed(SearchesOfOneSolid(), trace);
    return {exact_frame, one ? DualDepthExact::text.id : MultilayerExact::text.id,
            oracle::Surface::bilinear, one ? 2 : 4};
}

void set(ValueSet& values, std::span<const Value> list) {
    for (const Value v : list) values.set(static_cast<std::size_t>(v));
}

bool is_part_asked(const std::vector<ChannelSource>& channels, ErrorPart part) {
    return std::ranges::any_of(channels, [&](const ChannelSource& channel) {
        return is_error(channel) && channel.part == part;
    });
}

/// Whether light 0 has a shadow that someone searched.
bool casts_shadow(const std::vector<PlannedStage>& stages) {
    const PlannedStage* shadow = stage_of_room(stages, "shadow");
    return shadow != nullptr && shadow->info->text.id != std::string_view("shadow-none");
}

/// Whether the parameters of a frame are those of the exact one.
bool has_split(const StageChoice& frame) {
    return frame.id.empty() || frame.id == "frame-gram" || frame.id == exact_frame;
}

/// The material with the judge's stages for what a run replaces.
Material judged_material(const Material& material, const ErrorJudge& judge, JudgedRun run) {
    Material judged = material;
    if (run != JudgedRun::frame) {
        if (!has_split(material.frame)) judged.frame.parameters.clear();
        judged.frame.id = judge.frame;
    }
    if (run != JudgedRun::search) {
        judged.trace.id = judge.trace;
        judged.trace.parameters.clear();
    }
    return judged;
}

/// The values of a run that the channels' errors are differences of.
ValueSet values_of_run(const std::vector<ChannelSource>& channels, JudgedRun run,
                       const ErrorJudge& judge) {
    ValueSet values;
    for (const ChannelSource& channel : channels) {
        if (!is_error(channel)) continue;
        if (run == JudgedRun::truth || judged_run(channel.part) == run)
            set(values, judged_values(channel.measure));
    }
    if (run == JudgedRun::truth) {
        set(values, judged_values(ErrorMeasure::kind));
        set(values, std::array{Value::uv, Value::K});
        if (judge.layers == 0) set(values, oracle_outputs);
    }
    return values;
}

/// The judge's shadow of light 0 after all else: colour keeps that of the material's own stage.
void append_shadow_judge(const Scene& scene, Material material, const ErrorJudge& judge,
                         const KernelTable& kernels, MaterialPlan& plan) {
    material.shadow.id = judge.layers == 0 ? "shadow-oracle" : "shadow-layers-exact";
    material.shadow.parameters.clear();
    if (judge.layers == 0) material.shadow.parameters = {{"surface", name_of(judge.surface)}};
    Wanted wanted;
    wanted.values.set(static_cast<std::size_t>(Value::shadow_visibility));
    wanted.lights.set(0);
    MaterialPlan alone = plan_material(scene, material, wanted, kernels);
    plan.values |= alone.values;
    plan.produced |= alone.produced;
    plan.textures |= alone.textures;
    plan.in_arrays.set(static_cast<std::size_t>(Value::shadow_visibility));
    plan.stages.push_back(std::move(alone.stages.back()));
}

MaterialPlan plan_run(const Scene& scene, const Material& material, const ErrorPlan& errors,
                      const std::vector<ChannelSource>& channels, JudgedRun run,
                      const KernelTable& kernels) {
    const Material judged = judged_material(material, *errors.judge, run);
    constexpr auto visibility = static_cast<std::size_t>(Value::shadow_visibility);
    Wanted wanted{values_of_run(channels, run, *errors.judge), {}};
    wanted.lights.set(0, wanted.values[visibility]);
    const bool judges_shadow =
        errors.shadows && run != JudgedRun::search && wanted.values[visibility];
    if (judges_shadow) {
        wanted.values.reset(visibility);
        wanted.lights.reset();
        set(wanted.values, light_ray_inputs);
    }
    MaterialPlan plan = plan_material(scene, judged, wanted, kernels);
    if (judges_shadow) append_shadow_judge(scene, judged, *errors.judge, kernels, plan);
    return plan;
}

bool is_run(const std::vector<ChannelSource>& channels, JudgedRun run) {
    if (run == JudgedRun::truth) return true;
    return is_part_asked(channels, run == JudgedRun::search ? ErrorPart::search : ErrorPart::frame);
}

ErrorPlan plan_material_errors(const Scene& scene, const Material& material,
                               const std::vector<ChannelSource>& channels,
                               const KernelTable& kernels) {
    ErrorPlan plan;
    plan.judge = error_judge(scene, material);
    if (!plan.judge) return plan;
    plan.shadows = casts_shadow(material_stages(scene, material));
    for (const JudgedRun run : {JudgedRun::truth, JudgedRun::search, JudgedRun::frame})
        if (is_run(channels, run))
            plan.runs[static_cast<std::size_t>(run)] =
                plan_run(scene, material, plan, channels, run, kernels);
    return plan;
}

}  // namespace

bool is_error(const ChannelSource& channel) { return channel.kind == ChannelSource::Kind::error; }

std::optional<JudgedRun> judged_run(ErrorPart part) {
    if (part == ErrorPart::whole) return std::nullopt;
    return part == ErrorPart::search ? JudgedRun::search : JudgedRun::frame;
}

std::optional<ErrorJudge> error_judge(const Scene& scene, const Material& material) {
    if (draws_shell(material)) return std::nullopt;  // the judge knows polygons
    const std::vector<PlannedStage> stages = material_stages(scene, material);
    const PlannedStage& trace = *stage_of_room(stages, "trace");
    const std::string own = trace.info->text.id;
    if (reads_slot(trace, TextureSlot::layers)) {
        // Those of billboards have a ray of their own.
        const bool judged =
            material.textures.count("layers") != 0 && !reads_slot(trace, TextureSlot::layers_2);
        return judged ? std::optional(layer_judge(own)) : std::nullopt;
    }
    // Of heights it knows maps, and straight rays that end on them.
    if (material.noise || material.textures.count("height") == 0 || !is_judged(*trace.info))
        return std::nullopt;
    const std::string judge = stores(trace, Value::oracle_s)              ? own
                              : reads_slot(trace, TextureSlot::texel_max) ? "oracle-block"
                                                                          : "oracle-bilinear";
    return ErrorJudge{exact_frame, judge, surface_of(judge), 0};
}

std::vector<Value> judged_values(ErrorMeasure measure) {
    switch (measure) {
        case ErrorMeasure::normal:
            return {Value::N};
        case ErrorMeasure::shadow:
            return {Value::shadow_visibility};
        case ErrorMeasure::color:
            return {Value::color};
        case ErrorMeasure::K:
            return {Value::K};
        case ErrorMeasure::certified:
            return {};
        case ErrorMeasure::s:
        case ErrorMeasure::uv:
        case ErrorMeasure::cell:
        case ErrorMeasure::kind:
            break;
    }
    return {Value::hit_s, Value::hit_uv, Value::hit_status};
}

std::vector<ErrorPlan> plan_errors(const Scene& scene, const std::vector<ChannelSource>& channels,
                                   const KernelTable& kernels) {
    std::vector<ErrorPlan> plans;
    if (!std::ranges::any_of(channels, is_error)) return plans;
    for (const Material& material : scene.materials)
        plans.push_back(plan_material_errors(scene, material, channels, kernels));
    return plans;
}

std::string judges_text(const Scene& scene) {
    std::vector<std::string> lines;
    for (const Material& material : scene.materials) {
        const auto judge = error_judge(scene, material);
        lines.push_back(fmt::format(
            "{}: {}", material.name,
            judge ? fmt::format("{}, {}", judge->frame, judge->trace)
            : material.textures.count("height") != 0 || material.textures.count("layers") != 0
                ? "not judged, rays may pass the relief"
                : "not judged, no height map"));
    }
    return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace quadrel
