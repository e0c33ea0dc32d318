// The plan of a render, in words.
#include <fmt/format.h>

#include <algorithm>

#include "render/names.hpp"
#include "render/prepared.hpp"

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

void append_textures(const Scene& scene, const Material& material, const SlotSet& slots,
                     std::string& out) {
    for (const auto& [slot, reference] : material.textures) {
        bool read = false;
        for (int i = 0; i < texture_slot_count; ++i)
            read |= slots[i] && slot == slot_name(static_cast<TextureSlot>(i));
        out += fmt::format("  {} {} {}\n", read ? "loads" : "leaves out texture", slot,
                           reference.file.string());
    }
    if (!scene.environment) return;
    const bool read = slots[static_cast<std::size_t>(TextureSlot::environment)];
    out += fmt::format("  {} environment {}\n", read ? "loads" : "leaves out texture",
                       scene.environment->faces[0].string());
}

void append_material(const PreparedRender& prepared, std::size_t m, std::string& out) {
    const Scene& scene = *prepared.scene;
    const Material& material = scene.materials[m];
    const MaterialPlan& plan = prepared.plan.materials[m];
    out += fmt::format("material \"{}\"\n", material.name);
    if (!prepared.used[m]) {
        out += "  left out: nothing of it is in the window\n";
        return;
    }
    for (const PlannedStage& stage : material_stages(scene, material)) {
        if (planned(plan, stage))
            out += fmt::format("  runs {}: {}\n", stage_name(stage),
                               names(needed_outputs(plan, stage)));
        else
            out += fmt::format("  leaves out {}\n", stage_name(stage));
    }
    for (const PlannedStage& stage : prepared.plan.discard[m].stages)
        out += fmt::format("  to discard, runs {}\n", stage_name(stage));
    append_textures(scene, material, plan.textures | prepared.plan.discard[m].textures, out);
}

}  // namespace

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
        "triangles: {} submitted, {} to draw; left out: {} outside, {} culled, {} "
        "without area, {} off the frame, {} not finite\n",
        counts.submitted, counts.drawn, counts.outside, counts.culled, counts.zero_area,
        counts.off_frame, counts.non_finite);
    for (const Object& object : scene.objects)
        if (!object.visible)
            out += fmt::format("object \"{}\": left out, not visible\n", object.name);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) append_material(prepared, m, out);
    return out;
}

}  // namespace quadrel
