#include "render/integral/integral_scene.hpp"

#include <algorithm>

#include "quadrel/error.hpp"
#include "quadrel/scene/default_stage.hpp"
#include "render/draw/shell.hpp"
#include "render/plan/plan.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

/// The stage that runs; null where the name is unknown, about which the plan complains.
const StageInfo* stage_of(const Material& material, const StageChoice& choice, const char* room) {
    const std::string id =
        choice.id.empty() ? default_stage(room, height_source(material)) : choice.id;
    return find_stage(id == "none" ? std::string(room) + "-none" : id);
}

bool reads(const StageInfo& stage, TextureSlot slot) {
    return std::find(stage.textures.begin(), stage.textures.end(), slot) != stage.textures.end();
}

bool is_judge(const StageInfo& stage) {
    return std::find(stage.outputs.begin(), stage.outputs.end(), Value::oracle_s) !=
           stage.outputs.end();
}

void replace(StageChoice& choice, const char* id) {
    choice.id = id;
    choice.parameters.clear();
}

void replace_trace(const Scene& scene, Material& material) {
    const StageInfo* trace = stage_of(material, material.trace, "trace");
    if (trace == nullptr || is_judge(*trace) || std::string_view(trace->text.id) == "trace-none")
        return;
    if (material.noise)
        throw InputError(scene.file.string(), material.trace.key,
                         std::string("a search of noise, ") + trace->text.id,
                         "a height map, or no trace: integrals take the judge's hits");
    if (reads(*trace, TextureSlot::layers))
        throw InputError(scene.file.string(), material.trace.key,
                         std::string("a search of depth layers, ") + trace->text.id,
                         "a height map, or no trace: integrals take the judge's hits");
    if (trace->may_miss)
        throw InputError(scene.file.string(), material.trace.key,
                         std::string("a search that rays may pass, ") + trace->text.id,
                         "a search of a height map, or no trace: integrals take the judge's hits");
    replace(material.trace,
            reads(*trace, TextureSlot::texel_max) ? "oracle-block" : "oracle-bilinear");
}

/// Level 0, bilinear; what remains is where texels lie.
void sample_finest(SamplerState& sampler) {
    SamplerState finest;
    finest.wrap_u = sampler.wrap_u;
    finest.wrap_v = sampler.wrap_v;
    std::copy(std::begin(sampler.border), std::end(sampler.border), finest.border);
    finest.mag = finest.min = Filter::linear;
    finest.mip = MipFilter::none;
    sampler = finest;
}

}  // namespace

Scene integral_scene(const Scene& scene) {
    Scene changed = scene;
    changed.samples = 1;
    changed.centroid = false;
    changed.hardware = Hardware::exact;
    changed.derivatives.reset();
    for (Material& material : changed.materials) {
        replace_trace(scene, material);
        if (material.surface.id == "bump-blinn") replace(material.surface, "h2n-patch");
        for (auto& [slot, texture] : material.textures) sample_finest(texture.sampler);
    }
    if (changed.environment) sample_finest(changed.environment->sampler);
    return changed;
}

}  // namespace quadrel
