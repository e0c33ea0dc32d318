// The plan of a render, in words.
#include <fmt/format.h>

#include <algorithm>

#include "render/inject/injected_values.hpp"
#include "render/plan/names.hpp"
#include "render/plan/prepared.hpp"
#include "render/plan/textures.hpp"
#include "render/registry/added_stages.hpp"
#include "text/printable.hpp"
#include "texture/swizzle.hpp"

namespace quadrel {
namespace {

std::string names(const ValueSet& values) {
    std::vector<std::string> list;
    for (std::size_t v = 0; v < values.size(); ++v)
        if (values[v]) list.emplace_back(info(static_cast<Value>(v)).name);
    return list.empty() ? "nothing" : fmt::format("{}", fmt::join(list, " "));
}

std::string stage_name(const PlannedStage& stage) {
    const std::string id = stage.info->text.id;
    return stage.light < 0 ? id : fmt::format("{} (light {})", id, stage.light);
}

bool planned(const MaterialPlan& plan, const PlannedStage& stage) {
    return std::any_of(plan.stages.begin(), plan.stages.end(), [&](const PlannedStage& p) {
        return p.info == stage.info && p.light == stage.light;
    });
}

/// Values of a stage that something reads.
ValueSet needed_outputs(const MaterialPlan& plan, const PlannedStage& stage) {
    ValueSet out;
    for (const Value v : stage.info->outputs)
        out[static_cast<std::size_t>(v)] = plan.values[static_cast<std::size_t>(v)];
    return out;
}

/// What a material's part of the plan says.
struct MaterialText {
    std::vector<std::string> does, leaves_out;
};

/// What runs again for err.* channels.
void describe_judge(const ErrorPlan& plan, MaterialText& text) {
    if (!plan.judge) text.leaves_out.push_back("the judge: there is no height map");
    constexpr const char* purposes[] = {"for the truth", "for the error of the search",
                                        "for the error of the frame"};
    for (std::size_t run = 0; run < plan.runs.size(); ++run) {
        if (!plan.runs[run]) continue;
        std::vector<std::string> names;
        for (const PlannedStage& stage : plan.runs[run]->stages) names.push_back(stage_name(stage));
        text.does.push_back(fmt::format("runs {}: {}", purposes[run], fmt::join(names, ", ")));
    }
}

void describe_stages(const PreparedRender& prepared, std::size_t m, MaterialText& text) {
    const Scene& scene = *prepared.scene;
    const MaterialPlan& plan = prepared.plan.materials[m];
    for (const PlannedStage& stage : material_stages(scene, scene.materials[m])) {
        if (!planned(plan, stage) && stage.info->text.room == std::string_view("oracle")) continue;
        if (planned(plan, stage))
            text.does.push_back(fmt::format(
                "runs {}{}: {}", stage_name(stage),
                runs_on_plain_lanes(*prepared.plan.kernels, stage.info->text.id) ? " on plain lanes"
                                                                                 : "",
                names(needed_outputs(plan, stage))));
        else
            text.leaves_out.push_back(fmt::format("stage {}", stage_name(stage)));
    }
    for (const PlannedStage& stage : prepared.plan.discard[m].stages)
        text.does.push_back(fmt::format("runs {} to discard", stage_name(stage)));
    const RenderPlan& render = prepared.plan;
    if (!render.exact.empty())
        for (const PlannedStage& stage : render.exact[m].stages)
            text.does.push_back(fmt::format("runs {} on dual numbers", stage_name(stage)));
    for (const RangePlan* const ranges : {&render.bounds, &render.limits}) {
        if (ranges->materials.empty()) continue;
        for (const PlannedStage& stage : ranges->materials[m].stages)
            if (stage.run != nullptr)
                text.does.push_back(fmt::format(
                    "runs {} on ranges of {}", stage_name(stage),
                    ranges == &render.bounds ? "exact arithmetic" : "what a GPU may give"));
    }
    if (!render.errors.empty()) describe_judge(render.errors[m], text);
}

/// Ids of the planned stages that leave out steps by the heights of the map.
std::string stages_that_leave_out_steps(const MaterialPlan& plan) {
    std::vector<std::string> ids;
    for (const PlannedStage& stage : plan.stages)
        if (const std::string id = stage.info->text.id;
            leaves_out_steps(*stage.info, stage.params.data()) &&
            std::find(ids.begin(), ids.end(), id) == ids.end())
            ids.push_back(id);
    return fmt::format("{}", fmt::join(ids, ", "));
}

/// What the heights of the map spare, once it has been loaded; before, that they will be measured.
void describe_steps(const PreparedRender& prepared, std::size_t m, MaterialText& text) {
    const MaterialPlan& plan = prepared.plan.materials[m];
    const MaterialUniforms& uniforms = prepared.plan.uniforms[m];
    if (!may_leave_out_steps(plan) || uniforms.noise_octaves > 0) return;
    const std::string stages = stages_that_leave_out_steps(plan);
    if (uniforms.heights_bounded == 0 && uniforms.maxima == nullptr)
        text.does.push_back(fmt::format(
            "measures the height map, for steps of {} that no height can meet", stages));
    if (uniforms.maxima != nullptr)
        text.leaves_out.push_back(fmt::format("steps of {} above all heights around them", stages));
    if (uniforms.heights_bounded == 0) return;
    if (uniforms.height_low == uniforms.height_high)
        text.leaves_out.push_back(
            fmt::format("steps of {}: the height map is flat, {}", stages, uniforms.height_high));
    else if (uniforms.height_high < 1)
        text.leaves_out.push_back(
            fmt::format("steps of {} above height {}", stages, uniforms.height_high));
}

/// ": heights from r": the first channel of its swizzle.
std::string height_note(const TextureReference& reference) {
    const std::string swizzle = height_swizzle(reference);
    if (swizzle == alpha_or_first) return ": heights from a, or from r where it has no a";
    return ": heights from " + swizzle.substr(0, swizzle.starts_with("1-") ? 3 : 1);
}

void describe_texels(const PreparedRender& prepared, std::size_t m, const SlotSet& slots,
                     MaterialText& text) {
    const TexelsRead& read = prepared.plan.texels_read[m];
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (!slots[i]) continue;
        const std::string slot(slot_name(static_cast<TextureSlot>(i)));
        if (read.first_channel[i])
            text.leaves_out.push_back(fmt::format("channels of {} but the first", slot));
        if (read.finest_level[i] &&
            prepared.scene->materials[m].textures.at(slot).mip_rule != MipRule::none)
            text.leaves_out.push_back(fmt::format("levels of {} but the finest", slot));
    }
}

void describe_textures(const PreparedRender& prepared, std::size_t m, MaterialText& text) {
    const Scene& scene = *prepared.scene;
    const SlotSet slots = slots_read(prepared.plan, m);
    const auto describe = [&](const std::string& slot, const std::string& file,
                              const std::string& note = "") {
        bool read = false;
        for (int i = 0; i < texture_slot_count; ++i)
            read |= slots[i] && slot == slot_name(static_cast<TextureSlot>(i));
        if (read)
            text.does.push_back(fmt::format("loads {} {}{}", slot, file, note));
        else
            text.leaves_out.push_back(fmt::format("texture {} {}", slot, file));
    };
    for (const auto& [slot, reference] : scene.materials[m].textures)
        describe(slot, reference.file.string(),
                 slot == slot_name(TextureSlot::height) ? height_note(reference) : "");
    describe_texels(prepared, m, slots, text);
    if (scene.environment) describe("environment", scene.environment->faces[0].string());
    for (int i = static_cast<int>(first_baked_slot); i < texture_slot_count; ++i) {
        if (!slots[i]) continue;
        const auto slot = static_cast<TextureSlot>(i);
        text.does.push_back(
            fmt::format("derives {} from the {}", slot_name(slot),
                        source_of(slot) == TextureSlot::layers ? "depth layers" : "height map"));
    }
}

MaterialText describe(const PreparedRender& prepared, std::size_t m) {
    MaterialText text;
    if (!prepared.used[m]) {
        text.leaves_out.emplace_back("all of it: nothing of it is in the window");
        return text;
    }
    describe_stages(prepared, m, text);
    describe_textures(prepared, m, text);
    describe_steps(prepared, m, text);
    return text;
}

std::vector<std::string> hidden_objects(const Scene& scene) {
    std::vector<std::string> lines;
    for (const Object& object : scene.objects)
        if (!object.visible)
            lines.push_back(fmt::format("object \"{}\": not visible", object.name));
    return lines;
}

}  // namespace

std::vector<std::string> left_out(const PreparedRender& prepared) {
    std::vector<std::string> lines = hidden_objects(*prepared.scene);
    for (std::size_t m = 0; m < prepared.scene->materials.size(); ++m)
        for (const std::string& line : describe(prepared, m).leaves_out)
            lines.push_back(
                fmt::format("material \"{}\": {}", prepared.scene->materials[m].name, line));
    return lines;
}

std::string explain(const PreparedRender& prepared) {
    const Scene& scene = *prepared.scene;
    const KernelTable& kernels = *prepared.plan.kernels;
    std::string out = fmt::format("kernels: {}, {} lanes of {}\nchannels:", kernels.isa,
                                  kernels.lanes, kernels.scalar_bytes == 4 ? "float" : "double");
    for (const ChannelSource& channel : prepared.channels) out += " " + channel.name;
    const Window& w = prepared.window;
    out +=
        fmt::format("\nwindow: {},{},{},{} of {}x{}, {} sample{} a pixel\n", w.x0, w.y0, w.x1, w.y1,
                    scene.width, scene.height, scene.samples, scene.samples > 1 ? "s" : "");
    const PrimitiveCounts& counts = prepared.geometry.counts;
    out += fmt::format(
        "triangles: {} submitted, {} outside, {} not finite, {} clipped; of what is left, in "
        "pieces: {} to draw, {} culled, {} without area, {} off the frame\n",
        counts.submitted, counts.outside, counts.non_finite, counts.clipped, counts.drawn,
        counts.culled, counts.zero_area, counts.off_frame);
    if (prepared.plan.injected)
        for (const std::string& option : prepared.plan.injected->options())
            out += "takes " + printable(option) + "\n";
    for (const std::string& line : hidden_objects(scene))
        out += "leaves out " + printable(line) + "\n";
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const MaterialText text = describe(prepared, m);
        out += fmt::format("material \"{}\"\n", printable(scene.materials[m].name));
        for (const std::string& line : text.does) out += "  " + printable(line) + "\n";
        for (const std::string& line : text.leaves_out)
            out += "  leaves out " + printable(line) + "\n";
    }
    return out;
}

}  // namespace quadrel
