#include "render/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/document/stage_parameters.hpp"
#include "quadrel/check.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/rooms.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"
#include "render/draw/border_check.hpp"
#include "render/draw/shell.hpp"
#include "render/errors/error_plan.hpp"
#include "render/exact/observed.hpp"
#include "render/plan/chains.hpp"
#include "render/registry/added_stages.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

constexpr std::size_t index_of(Value v) { return static_cast<std::size_t>(v); }

std::vector<std::string> ids_of_room(std::string_view room) {
    std::vector<std::string> ids;
    for (const StageInfo& stage : all_stages())
        if (room == stage.text.room) ids.emplace_back(stage.text.id);
    return ids;
}

/// The stage that a scene names for a room; `none` is the room's own do-nothing stage.
const StageInfo& chosen_stage(const Scene& scene, const StageChoice& choice, std::string_view room,
                              HeightSource heights) {
    std::string id = choice.id;
    if (id.empty()) id = default_stage(room, heights);
    if (id == "none") id = fmt::format("{}-none", room);
    const StageInfo* stage = find_stage(id);
    if (stage && room == stage->text.room) return *stage;
    const std::vector<std::string> known = ids_of_room(room);
    const std::string nearest = nearest_word(choice.id, known);
    throw InputError(
        scene.file.string(), choice.key, fmt::format("unknown stage \"{}\"", choice.id),
        nearest.empty()
            ? fmt::format("one of {}", fmt::join(known, ", "))
            : fmt::format("\"{}\" perhaps; known are {}", nearest, fmt::join(known, ", ")));
}

void set_parameter(const Scene& scene, const StageChoice& choice, const StageInfo& stage,
                   const std::string& name, const ParameterValue& value, void* params) {
    const std::string key = choice.key + "." + name;
    const ParameterText* parameter = find_parameter(stage.text.id, name);
    if (parameter == nullptr) {
        std::vector<std::string> names;
        for (const ParameterText& p : stage.parameters) names.emplace_back(p.name);
        throw InputError(scene.file.string(), key, "an unknown parameter",
                         names.empty() ? fmt::format("none, {} takes no parameters", stage.text.id)
                                       : fmt::format("a parameter of {}: {}", stage.text.id,
                                                     fmt::join(names, ", ")));
    }
    const std::optional<double> number = number_of(*parameter, value);
    if (!number)
        throw InputError(scene.file.string(), key, text_of(value), expected_of(*parameter, value));
    parameter->set(params, *number);
}

PlannedStage make_stage(const StageInfo& info, int light = -1) {
    PlannedStage planned;
    planned.info = &info;
    planned.light = light;
    planned.params.resize(info.params_size / sizeof(std::max_align_t) + 1);
    info.set_defaults(planned.params.data());
    return planned;
}

PlannedStage make_chosen(const Scene& scene, const StageChoice& choice, std::string_view room,
                         HeightSource heights, int light = -1) {
    const StageInfo& info = chosen_stage(scene, choice, room, heights);
    PlannedStage planned = make_stage(info, light);
    for (const auto& [name, value] : choice.parameters)
        set_parameter(scene, choice, info, name, value, planned.params.data());
    return planned;
}

bool any_of(std::span<const Value> list, const ValueSet& set) {
    return std::any_of(list.begin(), list.end(), [&](Value v) { return set[index_of(v)]; });
}

/// The table of plain numbers whose bits a table has.
const KernelTable& plain_kernels(const KernelTable& table) {
    return table.scalar_bytes == sizeof(double) ? scalar_double_kernels() : scalar_float_kernels();
}

/// The judge of what a trace searches; none beside a trace that is one.
std::optional<PlannedStage> judge_of(const PlannedStage& trace) {
    if (stores(trace, Value::oracle_s)) return std::nullopt;
    PlannedStage judge = make_stage(*find_stage("oracle"));
    const auto& read = trace.info->textures;
    const bool blocks = std::find(read.begin(), read.end(), TextureSlot::texel_max) != read.end();
    judge.info->parameters[0].set(
        judge.params.data(),
        static_cast<double>(blocks ? oracle::Surface::block : oracle::Surface::bilinear));
    return judge;
}

StageFunction kernel(const KernelTable& table, std::string_view id) {
    if (const StageFunction run = find_kernel(table, id)) return run;
    if (const StageFunction run = find_kernel(plain_kernels(table), id)) return run;
    if (const StageFunction run = find_added_kernel(table, id)) return run;
    check_failed(__FILE__, __LINE__, "stage has a kernel", std::string(id));
}

bool has_clip_stage(const Material& material) {
    return !material.clip.id.empty() && material.clip.id != "none";
}

bool may_miss(const Material& material) {
    const std::string& id = material.trace.id;
    const StageInfo* trace =
        find_stage(id.empty() ? default_stage("trace", height_source(material)) : id);
    return trace != nullptr && trace->may_miss;
}

}  // namespace

HeightSource height_source(const Material& material) {
    if (material.noise) return HeightSource::noise;
    if (material.textures.count("height") != 0) return HeightSource::map;
    return material.textures.count("layers") != 0 ? HeightSource::layers : HeightSource::none;
}

bool clips(const Material& material) { return has_clip_stage(material) || may_miss(material); }

bool writes_depth(const Material& material) {
    return !material.frag_depth.id.empty() && material.frag_depth.id != "none";
}

bool stores(const PlannedStage& stage, Value v) {
    const auto& outputs = stage.info->outputs;
    return std::find(outputs.begin(), outputs.end(), v) != outputs.end();
}

bool is_last_to_store(const MaterialPlan& plan, std::size_t stage, Value v) {
    const PlannedStage& of = plan.stages[stage];
    return std::none_of(plan.stages.begin() + static_cast<std::ptrdiff_t>(stage) + 1,
                        plan.stages.end(), [&](const PlannedStage& later) {
                            return stores(later, v) &&
                                   (!info(v).per_light || later.light == of.light);
                        });
}

bool grades_depth(const Material& material) {
    return material.depth_in_tiles || material.fade_from < material.fade_to;
}

std::vector<PlannedStage> material_stages(const Scene& scene, const Material& material) {
    const HeightSource heights = height_source(material);
    const auto chosen = [&](const StageChoice& choice, const char* room, int light = -1) {
        return make_chosen(scene, choice, room, heights, light);
    };
    std::vector<PlannedStage> stages;
    for (const char* id : {"interpolate", "differentiate", "lod"})
        stages.push_back(make_stage(*find_stage(id)));
    stages.push_back(
        make_stage(*find_stage(grades_depth(material) ? "depth-graded" : "depth-constant")));
    stages.push_back(chosen(material.frame, "frame"));
    PlannedStage trace = chosen(material.trace, "trace");
    if (draws_shell(material))
        stages.push_back(make_stage(*find_stage("oracle-none")));
    else if (auto judge = judge_of(trace))
        stages.push_back(*std::move(judge));
    stages.push_back(std::move(trace));
    if (has_clip_stage(material)) stages.push_back(chosen(material.clip, "clip"));
    const bool strips = shell_kind(material) == ShellKind::strips;
    stages.push_back(make_stage(*find_stage(strips ? "displace-prism@published" : "displace")));
    stages.push_back(writes_depth(material) ? chosen(material.frag_depth, "frag-depth")
                                            : make_stage(*find_stage("frag-depth")));
    stages.push_back(chosen(material.surface, "surface"));
    for (int light = 0; light < static_cast<int>(scene.lights.size()); ++light)
        stages.push_back(chosen(material.shadow, "shadow", light));
    stages.push_back(chosen(material.occlusion, "occlusion"));
    stages.push_back(chosen(material.shade, "shade"));
    return stages;
}

MaterialPlan plan_material(const Scene& scene, const Material& material, const Wanted& wanted,
                           const KernelTable& table) {
    MaterialPlan plan;
    plan.values = plan.wanted = wanted.values;
    LightSet lights = wanted.lights;
    std::vector<PlannedStage> stages = material_stages(scene, material);
    for (auto stage = stages.rbegin(); stage != stages.rend(); ++stage) {
        if (!any_of(stage->info->outputs, plan.values)) continue;
        if (stage->light >= 0 && !lights[static_cast<std::size_t>(stage->light)]) continue;
        for (const Value v : stage->info->inputs) {
            plan.values.set(index_of(v));
            if (info(v).per_light) lights.set();
        }
        for (const Value v : stage->info->outputs) plan.produced.set(index_of(v));
        for (const TextureSlot slot : stage->info->textures) {
            plan.textures.set(static_cast<std::size_t>(slot));
            const std::string_view room = stage->info->text.room;
            const bool optional = room == "quad" || room == "oracle";
            const bool baked = slot >= first_baked_slot;
            const bool layers = source_of(slot) == TextureSlot::layers;
            plan.needs_height |= (slot == TextureSlot::height || baked) && !optional && !layers;
            if (layers) plan.needs_layers = stage->info;
            if ((baked && !optional && !layers) || stage->info->needs_height_map)
                plan.needs_height_map = stage->info;
        }
        stage->run = kernel(table, stage->info->text.id);
        plan.stages.push_back(std::move(*stage));
    }
    std::reverse(plan.stages.begin(), plan.stages.end());
    for (PlannedStage& stage : plan.stages) stage.checks = border_checks(stage, plan.values);
    find_chains(plan, table);
    return plan;
}

Wanted all_values(const std::vector<ChannelSource>& channels) {
    Wanted all{ValueSet().set(), LightSet().set()};
    const Wanted asked = wanted_values(channels);
    for (const Value v : oracle_outputs) all.values[index_of(v)] = asked.values[index_of(v)];
    return all;
}

Wanted wanted_values(const std::vector<ChannelSource>& channels) {
    Wanted wanted;
    for (const ChannelSource& channel : channels) {
        if (channel.kind == ChannelSource::Kind::exact ||
            channel.kind == ChannelSource::Kind::exact_error) {  // drawn, too: to compare with
            wanted.values.set(index_of(channel.value));
            for (const Value v : inputs_of(channel.observed)) wanted.values.set(index_of(v));
        }
        if (channel.kind == ChannelSource::Kind::integral_error)
            wanted.values.set(index_of(channel.value));
        if (channel.kind == ChannelSource::Kind::value || channel.range_set != RangeSet::none) {
            wanted.values.set(index_of(channel.value));
            if (info(channel.value).per_light)
                wanted.lights.set(static_cast<std::size_t>(channel.light));
        }
        if (channel.kind == ChannelSource::Kind::error && channel.part == ErrorPart::whole)
            for (const Value v : judged_values(channel.measure)) {
                wanted.values.set(index_of(v));
                if (info(v).per_light) wanted.lights.set(0);
            }
        if (certifies_pixels(channel))  // against what is proven of the drawn ray
            for (const Value v : {Value::oracle_status, Value::oracle_cell, Value::certified})
                wanted.values.set(index_of(v));
        if (channel.kind == ChannelSource::Kind::z) wanted.values.set(index_of(Value::hit_P));
    }
    // Statistics tell fragments without a ray from those whose hit is not proven.
    if (wanted.values[index_of(Value::certified)])
        wanted.values.set(index_of(Value::certified_reason));
    return wanted;
}

}  // namespace quadrel
