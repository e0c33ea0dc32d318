#include "render/plan/textures.hpp"

#include <fmt/format.h>

#include <string>

#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/error.hpp"
#include "text/shell_word.hpp"
#include "texture/swizzle.hpp"
#include "texture/texel_format.hpp"

namespace quadrel {
namespace {

TextureOptions texture_options(const TextureReference& reference, TextureSlot slot) {
    TextureOptions options;
    options.swizzle = reference.swizzle;
    if (slot == TextureSlot::height) options.swizzle = height_swizzle(reference);
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
                      reference.allow_nan ? NotFinite::count : NotFinite::refuse,
                      reference.selection);
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
    out.owned[slot] = cache.load_cube(environment.faces, options, environment.selections);
    out.sampled[slot] = {out.owned[slot]->view(), environment.sampler};
}

/// The height map as arguments of `quadrel bake`.
std::string bake_arguments(const TextureReference& reference) {
    std::string arguments =
        shell_word(reference.file.string()) + " --channel " + height_swizzle(reference);
    if (!reference.selection.layer.empty())
        arguments += " --layer " + shell_word(reference.selection.layer);
    if (!reference.selection.part.empty())
        arguments += " --part " + shell_word(reference.selection.part);
    if (reference.format) arguments += fmt::format(" --format {}", format_name(*reference.format));
    if (reference.flip_v) arguments += " --flip-v";
    return arguments;
}

/// A material's height map, read once for all that is derived from it.
class HeightMap {
  public:
    /// `loaded`: that of the render, or null where it does without.
    HeightMap(const TextureReference& named, TextureCache& cache,
              std::shared_ptr<const Texture> loaded)
        : reference(named), cache_(&cache), texture_(std::move(loaded)) {}

    /// Level 0 is the same under every mip rule, and all that bakes read.
    const Texture& level_0() {
        TextureReference alone = reference;
        alone.mip_rule = MipRule::none;
        if (!texture_) texture_ = load(*cache_, alone, TextureSlot::height);
        return *texture_;
    }
    const TextureReference& reference;

  private:
    TextureCache* cache_;
    std::shared_ptr<const Texture> texture_;
};

/// Binds what is derived from heights, under the wrap modes that they are sampled with. Throws
/// InputError for a map that takes too long.
void load_baked(const Scene& scene, HeightMap& heights, TextureSlot slot,
                const BakingListener& baking, MaterialTextures& out) {
    const TextureReference& reference = heights.reference;
    BakedTextureOptions options;
    options.input = bake_arguments(reference);
    options.key = reference.key;
    options.not_kept = baking.not_kept;
    if (baking.progress)
        options.progress = [&, map = fmt::format("{} map", slot_name(slot))](double share) {
            baking.progress(map, share);
        };
    const auto i = static_cast<std::size_t>(slot);
    try {
        out.owned[i] = baked_texture(heights.level_0(), bake_kind_from_name(slot_name(slot)),
                                     reference.sampler, options);
    } catch (const InputError& error) {
        throw InputError(scene.file.string(), error.key, error.found, error.expected);
    }
    out.sampled[i] = {out.owned[i]->view(), reference.sampler};
}

}  // namespace

std::string height_swizzle(const TextureReference& reference) {
    return reference.swizzle.empty() ? "r" : reference.swizzle;
}

MaterialTextures load_textures(const Scene& scene, const Material& material, const SlotSet& slots,
                               TextureCache& cache, const BakingListener& baking) {
    MaterialTextures out;
    for (int i = 0; i < texture_slot_count; ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        if (!slots[i] || slot >= first_baked_slot) continue;
        if (slot == TextureSlot::environment) {
            load_environment(scene, cache, out);
            continue;
        }
        const auto found = material.textures.find(std::string(slot_name(slot)));
        if (found == material.textures.end()) continue;
        const TextureReference& reference = found->second;
        out.owned[i] = load(cache, reference, slot);
        out.sampled[i] = {out.owned[i]->view(), reference.sampler};
    }
    const auto height = material.textures.find(std::string(slot_name(TextureSlot::height)));
    if (height == material.textures.end()) return out;
    HeightMap heights(height->second, cache,
                      out.owned[static_cast<std::size_t>(TextureSlot::height)]);
    for (int i = static_cast<int>(first_baked_slot); i < texture_slot_count; ++i)
        if (slots[i]) load_baked(scene, heights, static_cast<TextureSlot>(i), baking, out);
    return out;
}

}  // namespace quadrel
