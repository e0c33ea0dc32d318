#include "export/scene/material_program.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "render/draw/geometry.hpp"
#include "render/draw/shell.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel {
namespace {

/// What decides over fragments comes first in a plan of its own; a program has all stages once.
std::vector<const PlannedStage*> stages_of(const RenderPlan& plan, std::size_t material,
                                           const std::vector<PlannedStage>& all) {
    std::vector<const PlannedStage*> needed;
    const auto is_planned = [&](const MaterialPlan& of, const PlannedStage& stage) {
        return std::any_of(of.stages.begin(), of.stages.end(), [&](const PlannedStage& other) {
            return other.info == stage.info && other.light == stage.light;
        });
    };
    for (const PlannedStage& stage : all)
        if (is_planned(plan.materials[material], stage) ||
            is_planned(plan.discard[material], stage))
            needed.push_back(&stage);
    return needed;
}

}  // namespace

MaterialProgram::MaterialProgram(const ExportContent& content, const RenderPlan& plan,
                                 std::size_t material)
    : material_(material),
      all_(material_stages(*content.scene, content.scene->materials[material])),
      needed_(stages_of(plan, material, all_)),
      // Without bounds of heights, by which steps are left out.
      uniforms_(material_uniforms(content.scene->materials[material])) {
    const Scene& scene = *content.scene;
    const Material& of = scene.materials[material];
    for (const PlannedStage* stage : needed_)
        uses_.push_back({stage->info->text.id, stage->params.data(), std::max(stage->light, 0)});
    request_.language = content.language.c_str();
    request_.material = of.name.c_str();
    request_.stages = uses_.data();
    request_.stage_count = static_cast<std::int32_t>(uses_.size());
    request_.frame = &content.frame;
    request_.uniforms = &uniforms_;
    for (int slot = 0; slot < texture_slot_count; ++slot)
        request_.textures[slot] = plan.textures[material].bound(slot);
    request_.passes = content.passes.data();
    request_.pass_count = static_cast<std::int32_t>(content.passes.size());
    request_.discard_below = of.discard_below;
    request_.clips = clips(of);
    request_.writes_depth = writes_depth(of);
    for (const Object& object : scene.objects)
        request_.has_flat_meshes |= object.visible && object.material == material &&
                                    scene.meshes[object.mesh].normals.empty();
    request_.centroid = scene.centroid && scene.samples > 1;
    request_.draws_shells = draws_shell(of);
}

std::vector<std::string> MaterialProgram::stage_names() const {
    std::vector<std::string> names;
    for (const PlannedStage* stage : needed_) {
        names.push_back(fmt::format("{}/{}", stage->info->text.room, stage->info->text.id));
        if (stage->light >= 0) names.back() += fmt::format(" (light {})", stage->light);
    }
    return names;
}

}  // namespace quadrel
