#include "render/plan/render_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "quadrel/error.hpp"
#include "quadrel/quad/interpolate.hpp"
#include "quadrel/relief/trace/search/near_surface.hpp"
#include "render/draw/border_check.hpp"
#include "render/exact/exact_plan.hpp"
#include "render/exact/observed.hpp"
#include "render/plan/height_bounds.hpp"
#include "render/plan/shell_check.hpp"

namespace quadrel {
namespace {

MaterialPlan discard_plan(const Scene& scene, const Material& material,
                          const KernelTable& kernels) {
    ValueSet wanted;
    if (material.discard_below >= 0) wanted.set(static_cast<std::size_t>(Value::opacity));
    if (clips(material)) wanted.set(static_cast<std::size_t>(Value::hit_status));
    if (writes_depth(material)) wanted.set(static_cast<std::size_t>(Value::frag_depth));
    return plan_material(scene, material, {wanted, {}}, kernels);
}

void check_lights(const Scene& scene) {
    if (scene.lights.size() > max_lights)
        throw InputError(scene.file.string(), "lights",
                         fmt::format("{} lights", scene.lights.size()),
                         fmt::format("at most {}", max_lights));
}

void check_height(const Scene& scene, const Material& material, const MaterialPlan& plan) {
    const std::string key =
        (material.key.empty() ? "materials." + material.name : material.key) + ".height";
    if (material.noise && plan.needs_height_map)
        throw InputError(scene.file.string(), key, "noise",
                         fmt::format("a texture: {} reads texels", plan.needs_height_map->text.id));
    if (plan.needs_height && !material.noise && material.textures.count("height") == 0)
        throw InputError(scene.file.string(), key, "nothing",
                         "a texture: the material's relief stages read heights");
}

void check_layers(const Scene& scene, const Material& material, const MaterialPlan& plan) {
    if (plan.needs_layers == nullptr || material.textures.count("layers") != 0) return;
    const std::string key = material.key.empty() ? "materials." + material.name : material.key;
    throw InputError(
        scene.file.string(), key + ".layers", "nothing",
        fmt::format("a texture of depth layers: {} reads them", plan.needs_layers->text.id));
}

constexpr auto height_slot = static_cast<std::size_t>(TextureSlot::height);

/// Whether the stage's search, at its parameters, goes by what the height map can give anywhere.
bool reads_bounds(const PlannedStage& stage) {
    return stage.info->uses_height_bounds && leaves_out_steps(*stage.info, stage.params.data());
}

/// Tells the stages what the height map can give anywhere.
void bound_heights(RenderPlan& plan, std::size_t material, const SampledTexture& map,
                   TextureCache& cache) {
    const auto& stages = plan.materials[material].stages;
    if (std::none_of(stages.begin(), stages.end(), reads_bounds)) return;
    const auto range = height_range(map, plan.textures[material].owned[height_slot]->id(), cache);
    if (!range) return;
    MaterialUniforms& uniforms = plan.uniforms[material];
    uniforms.heights_bounded = 1;
    uniforms.height_low = range->low;
    uniforms.height_high = range->high;
}

/// Whether bounds of parts of the map spare more than they take: some nanoseconds a texel, a few a
/// step.
bool pays_off(const MaterialPlan& plan, const TextureView& map, std::int64_t pixels) {
    std::int64_t steps = 0;
    for (const PlannedStage& stage : plan.stages)
        if (stage.info->lattice_steps != nullptr) {
            const std::int64_t made = stage.info->lattice_steps(stage.params.data());
            if (made >= fewest_steps_to_leave_out) steps += made;
        }
    return steps * pixels >= 2 * std::int64_t(map.width[0]) * map.height[0];
}

/// Tells the stages what parts of the height map can give at most.
void bound_parts(RenderPlan& plan, std::size_t material, const SampledTexture& map,
                 TextureCache& cache, std::int64_t pixels) {
    MaterialUniforms& uniforms = plan.uniforms[material];
    const bool flat = uniforms.heights_bounded != 0 && uniforms.height_low == uniforms.height_high;
    if (flat || !pays_off(plan.materials[material], map.view, pixels)) return;
    const auto maxima = height_maxima(*plan.textures[material].owned[height_slot], map.sampler);
    if (!maxima) return;
    for (const auto& texture : maxima->textures) cache.keep(texture->id(), texture);
    plan.maxima[material] = maxima;
    uniforms.maxima = &maxima->maxima;
}

/// Tells the stages that leave out steps what they do so by.
void bound_material(RenderPlan& plan, std::size_t material, TextureCache& cache,
                    std::int64_t pixels) {
    const SampledTexture* map = plan.textures[material].bound(static_cast<int>(height_slot));
    if (!map || plan.uniforms[material].noise_octaves > 0) return;
    if (!may_leave_out_steps(plan.materials[material])) return;
    bound_heights(plan, material, *map, cache);
    bound_parts(plan, material, *map, cache, pixels);
}

/// Whether exact derivatives of heights are asked for: that reads them, whatever stages do.
bool observes_heights(const std::vector<ChannelSource>& channels) {
    return std::any_of(channels.begin(), channels.end(), [](const ChannelSource& channel) {
        return reads_heights(channel.observed);
    });
}

/// The texels of those that are decoded from sRGB8.
std::vector<const float*> srgb_maps(const std::vector<MaterialTextures>& textures) {
    std::vector<const float*> maps;
    for (const MaterialTextures& of_material : textures)
        for (const auto& texture : of_material.owned)
            if (texture && texture->format() == TexelFormat::srgb8 &&
                std::ranges::count(maps, texture->view().texels) == 0)
                maps.push_back(texture->view().texels);
    return maps;
}

}  // namespace

RenderPlan make_render_plan(const Scene& scene, const std::vector<ChannelSource>& channels,
                            const KernelTable& kernels, bool skip, const std::string& limits,
                            std::shared_ptr<const InjectedValues> injected) {
    check_lights(scene);
    RenderPlan plan;
    plan.hardware = scene_hardware(scene);
    plan.kernels = &kernels;
    plan.scalar_bytes = kernels.scalar_bytes;
    if (!skip) plan.shortcuts = no_shortcuts;
    plan.frame = frame_uniforms(scene, plan.hardware);
    const Wanted wanted = skip ? wanted_values(channels) : all_values(channels);
    for (const Material& material : scene.materials) {
        check_shell(scene, material);
        plan.materials.push_back(plan_material(scene, material, wanted, kernels));
        plan.discard.push_back(discard_plan(scene, material, kernels));
        check_height(scene, material, plan.materials.back());
        check_height(scene, material, plan.discard.back());
        check_layers(scene, material, plan.materials.back());
        check_layers(scene, material, plan.discard.back());
        plan.uniforms.push_back(material_uniforms(material));
        if (observes_heights(channels) && material.textures.count("height") != 0)
            plan.materials.back().textures.set(height_slot);
    }
    plan.exact = plan_exact(scene, channels);
    plan.errors = plan_errors(scene, channels, kernels);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        plan.texels_read.push_back(skip ? texels_read(scene.materials[m], plans_that_load(plan, m))
                                        : TexelsRead());
        if (observes_heights(channels)) plan.texels_read.back().finest_level.reset(height_slot);
    }
    plan.bounds = plan_ranges(scene, channels, RangeSet::exact, limits);
    plan.limits = plan_ranges(scene, channels, RangeSet::gpu, limits, injected.get());
    plan.injected = std::move(injected);
    plan.textures.resize(scene.materials.size());
    return plan;
}

std::vector<const MaterialPlan*> plans_that_load(const RenderPlan& plan, std::size_t material) {
    std::vector<const MaterialPlan*> plans{&plan.materials[material], &plan.discard[material]};
    if (plan.errors.empty()) return plans;
    for (const auto& run : plan.errors[material].runs)
        if (run) plans.push_back(&*run);
    return plans;
}

SlotSet slots_read(const RenderPlan& plan, std::size_t material) {
    SlotSet slots;
    for (const MaterialPlan* reader : plans_that_load(plan, material)) slots |= reader->textures;
    return slots;
}

GeometryParts parts_read(const RenderPlan& plan) {
    GeometryParts parts;
    parts.all_triangles = plan.integral.has_value();
    for (std::size_t m = 0; m < plan.materials.size(); ++m) {
        for (const MaterialPlan* material : plans_that_load(plan, m)) {
            for (const Value v : frame_values)
                parts.frames |= material->values[static_cast<std::size_t>(v)];
            parts.quadrics |= material->values[static_cast<std::size_t>(Value::quadric)];
            for (const PlannedStage& stage : material->stages)
                parts.vertices |= stage.info->reads_vertices;
        }
    }
    return parts;
}

bool may_leave_out_steps(const MaterialPlan& plan) {
    for (const Value v : {Value::hit_steps, Value::hit_fetches, Value::shadow_steps})
        if (plan.values[static_cast<std::size_t>(v)]) return false;
    return std::any_of(plan.stages.begin(), plan.stages.end(), [](const PlannedStage& stage) {
        return leaves_out_steps(*stage.info, stage.params.data());
    });
}

std::vector<bool> used_materials(const Scene& scene, const Geometry& geometry,
                                 const PixelRect& area) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const DrawnTriangle& triangle : geometry.triangles)
        if (!intersect(area, triangle.screen.bounds).empty()) used[triangle.material] = true;
    return used;
}

void load_plan_textures(const Scene& scene, const std::vector<bool>& used, RenderPlan& plan,
                        const BakingListener& baking, std::int64_t pixels) {
    std::vector<SlotSet> slots(scene.materials.size());
    for (std::size_t m = 0; m < slots.size(); ++m)
        if (used[m]) slots[m] = slots_read(plan, m);
    plan.textures = load_textures(scene, slots, plan.texels_read, *scene.texture_cache, baking);
    plan.limits.srgb_maps = srgb_maps(plan.textures);
    plan.maxima.resize(scene.materials.size());
    for (std::size_t m = 0; m < slots.size(); ++m)
        if (used[m]) bound_material(plan, m, *scene.texture_cache, pixels);
}

RenderPlan plan_with_steps(const RenderPlan& plan) {
    RenderPlan counting = plan;
    for (auto* const list : {&counting.materials, &counting.discard})
        for (MaterialPlan& material : *list) {
            for (const Value v : {Value::hit_steps, Value::shadow_steps})
                if (material.produced[static_cast<std::size_t>(v)])
                    material.values.set(static_cast<std::size_t>(v));
            for (PlannedStage& stage : material.stages)
                stage.checks = border_checks(stage, material.values);
        }
    // What bounds of parts of a map leave out depends on what a thread has learnt before.
    for (MaterialUniforms& material : counting.uniforms) material.maxima = nullptr;
    return counting;
}

StageCall stage_call(const RenderPlan& plan, std::uint32_t material) {
    StageCall call{};
    call.material = &plan.uniforms[material];
    call.frame = &plan.frame;
    for (int slot = 0; slot < texture_slot_count; ++slot)
        call.textures[slot] = plan.textures[material].bound(slot);
    return call;
}

}  // namespace quadrel
