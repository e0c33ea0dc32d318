#include "render/textures.hpp"

#include <fmt/format.h>

#include <string>

#include "quadrel/bake.hpp"
#include "quadrel/error.hpp"
#include "texture/swizzle.hpp"

namespace quadrel {
namespace {

/// A render waits this long for a baked map, in seconds; what takes longer is baked beforehand.
constexpr double longest_bake = 20;

TextureOptions texture_options(const TextureReference& reference, TextureSlot slot) {
    TextureOptions options;
    options.swizzle = reference.swizzle;
    if (slot == TextureSlot::height && reference.swizzle.empty()) options.swizzle = height_swizzle;
    options.srgb = reference.srgb;
    options.format = reference.format;
    options.mip_rule = reference.mip_rule;
    options.flip_v = reference.flip_v;
    options.key = reference.key;
    return options;
}

std::shared_ptr<const Texture> load(TextureCache& cache, const TextureReference& reference,
                                    TextureSlot slot) {
    return cache.load(reference.file, texture_options(reference, slot),
                      reference.allow_nan ? NotFinite::count : NotFinite::refuse);
}

void load_environment(const Scene& scene, TextureCache& cache, MaterialTextures& out) {
    if (!scene.environment) return;
    const Environment& environment = *scene.environment;
    constexpr auto slot = static_cast<std::size_t>(TextureSlot::environment);
    TextureOptions options;
    options.srgb = environment.srgb;
    options.format = environment.format;
    options.mip_rule = environment.mip_rule;
    options.key = environment.key;
    out.owned[slot] = cache.load_cube(environment.faces, options);
    out.sampled[slot] = {out.owned[slot]->view(), environment.sampler};
}

/// What is derived from a height field, under the wrap modes that it is sampled with. Throws
/// InputError for a map that would take too long.
std::shared_ptr<const Texture> baked_map(const Scene& scene, const TextureReference& reference,
                                         const Texture& height, TextureSlot slot) {
    const std::string name(slot_name(slot));
    const BakeKind kind = bake_kind_from_name(name);
    const TextureView& view = height.view();
    const double seconds = bake_seconds_estimate(kind, view.width[0], view.height[0]);
    if (seconds > longest_bake) {
        throw InputError(
            scene.file.string(), reference.key,
            fmt::format("{} x {} texels, whose {} map takes up to {:.0f} s", view.width[0],
                        view.height[0], name, seconds),
            fmt::format("a map that takes at most {:.0f} s, or one made beforehand by `quadrel "
                        "bake {} --kind {}`",
                        longest_bake, reference.file.string(), name));
    }
    return bake(height, kind, reference.sampler);
}

/// Binds slot's map of a material that has a height map.
void load_baked(const Scene& scene, const Material& material, TextureSlot slot, TextureCache& cache,
                MaterialTextures& out) {
    const auto found = material.textures.find(std::string(slot_name(TextureSlot::height)));
    if (found == material.textures.end()) return;
    const TextureReference& reference = found->second;
    const auto height = load(cache, reference, TextureSlot::height);
    const auto i = static_cast<std::size_t>(slot);
    out.owned[i] = baked_map(scene, reference, *height, slot);
    out.sampled[i] = {out.owned[i]->view(), reference.sampler};
}

}  // namespace

MaterialTextures load_textures(const Scene& scene, const Material& material, const SlotSet& slots,
                               TextureCache& cache) {
    MaterialTextures out;
    for (int i = 0; i < texture_slot_count; ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        if (!slots[i]) continue;
        if (slot == TextureSlot::environment) {
            load_environment(scene, cache, out);
            continue;
        }
        if (slot >= first_baked_slot) {
            load_baked(scene, material, slot, cache, out);
            continue;
        }
        const auto found = material.textures.find(std::string(slot_name(slot)));
        if (found == material.textures.end()) continue;
        const TextureReference& reference = found->second;
        out.owned[i] = load(cache, reference, slot);
        out.sampled[i] = {out.owned[i]->view(), reference.sampler};
    }
    return out;
}

}  // namespace quadrel
