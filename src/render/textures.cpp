#include "render/textures.hpp"

#include <string>

namespace quadrel {
namespace {

/// Heights are one channel: alpha where the file has one (the usual place beside a normal or a
/// colour), else the first.
std::string height_swizzle(const TextureReference& reference) {
    if (!reference.swizzle.empty()) return reference.swizzle;
    const int channels = load_image(reference.file).channels;
    return channels == 2 || channels == 4 ? "a" : "r";
}

TextureOptions texture_options(const TextureReference& reference, TextureSlot slot) {
    TextureOptions options;
    options.swizzle = slot == TextureSlot::height ? height_swizzle(reference) : reference.swizzle;
    options.srgb = reference.srgb;
    options.format = reference.format;
    options.mip_rule = reference.mip_rule;
    options.flip_v = reference.flip_v;
    options.key = reference.key;
    return options;
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
        const auto found = material.textures.find(std::string(slot_name(slot)));
        if (found == material.textures.end()) continue;
        const TextureReference& reference = found->second;
        out.owned[i] = cache.load(reference.file, texture_options(reference, slot));
        out.sampled[i] = {out.owned[i]->view(), reference.sampler};
    }
    return out;
}

}  // namespace quadrel
