#include "render/plan/textures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <string>

#include "file/file_store.hpp"
#include "quadrel/bake/baked_texture.hpp"
#include "quadrel/error.hpp"
#include "render/prewarp/prewarp.hpp"
#include "text/first_error.hpp"
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

/// An image file that a slot of a material needs: its own, or the heights that its map is baked
/// from.
struct Need {
    std::size_t material;
    TextureSlot slot;
    TextureReference reference;
    bool finest_level = false, first_channel = false;  ///< nothing else is read (TexelsRead)
    bool reads_all() const { return !finest_level && !first_channel; }
};

std::optional<Need> need_of(const Scene& scene, std::size_t material, TextureSlot slot) {
    const bool baked = slot >= first_baked_slot;
    const auto& textures = scene.materials[material].textures;
    const auto found = textures.find(std::string(slot_name(source_of(slot))));
    if (slot == TextureSlot::environment || found == textures.end()) return std::nullopt;
    Need need{material, slot, found->second};
    // Level 0 alone, as the bake command reads it: then both find the same entries of the cache.
    if (baked) need.reference.mip_rule = MipRule::none;
    return need;
}

/// Whether both are level by level one texture.
bool is_same_texture(const Need& a, const Need& b) {
    const TextureReference &x = a.reference, &y = b.reference;
    return x.file == y.file && x.selection == y.selection && x.srgb == y.srgb &&
           x.format == y.format && x.mip_rule == y.mip_rule && x.flip_v == y.flip_v &&
           texture_options(x, a.slot).swizzle == texture_options(y, b.slot).swizzle &&
           x.allow_nan == y.allow_nan;
}

/// What is not read is left out, unless another need has the whole texture.
void leave_out_texels(std::vector<Need>& needs) {
    for (Need& need : needs)
        if (std::any_of(needs.begin(), needs.end(), [&](const Need& other) {
                return other.reads_all() && is_same_texture(need, other);
            }))
            need.finest_level = need.first_channel = false;
    for (Need& need : needs) {
        if (need.finest_level) need.reference.mip_rule = MipRule::none;
        if (need.first_channel) need.reference.swizzle = "r";
    }
}

/// In the order of materials and slots.
std::vector<Need> all_needs(const Scene& scene, const std::vector<SlotSet>& slots,
                            const std::vector<TexelsRead>& read) {
    std::vector<Need> needs;
    for (std::size_t material = 0; material < slots.size(); ++material)
        for (int i = 0; i < texture_slot_count; ++i)
            if (slots[material][static_cast<std::size_t>(i)])
                if (auto need = need_of(scene, material, static_cast<TextureSlot>(i))) {
                    need->finest_level = read[material].finest_level[static_cast<std::size_t>(i)];
                    need->first_channel = read[material].first_channel[static_cast<std::size_t>(i)];
                    needs.push_back(*std::move(need));
                }
    leave_out_texels(needs);
    return needs;
}

std::vector<std::shared_ptr<const Texture>> load_all(const std::vector<Need>& needs,
                                                     TextureCache& cache) {
    std::vector<TextureRequest> requests;
    for (const Need& need : needs) {
        requests.push_back({need.reference.file,
                            texture_options(need.reference, source_of(need.slot)),
                            need.reference.allow_nan ? NotFinite::count : NotFinite::refuse,
                            need.reference.selection});
    }
    return cache.load(requests);
}

/// For the materials that reflect it.
void load_environment(const Scene& scene, const std::vector<SlotSet>& slots, TextureCache& cache,
                      std::vector<MaterialTextures>& textures) {
    constexpr auto slot = static_cast<std::size_t>(TextureSlot::environment);
    const bool any =
        std::any_of(slots.begin(), slots.end(), [](const SlotSet& needed) { return needed[slot]; });
    if (!scene.environment || !any) return;
    const Environment& environment = *scene.environment;
    TextureOptions options;
    options.srgb = environment.srgb;
    options.format = environment.format;
    options.mip_rule = environment.mip_rule;
    options.key = environment.key;
    const auto cube = cache.load_cube(environment.faces, options, environment.selections);
    for (std::size_t m = 0; m < slots.size(); ++m)
        if (slots[m][slot]) {
            textures[m].owned[slot] = cube;
            textures[m].sampled[slot] = {cube->view(), environment.sampler};
        }
}

/// The map that one is baked from, as arguments of `quadrel bake`.
std::string bake_arguments(const TextureReference& reference, TextureSlot source) {
    std::string arguments = shell_word(reference.file.string());
    if (source == TextureSlot::height) arguments += " --channel " + height_swizzle(reference);
    if (!reference.selection.layer.empty())
        arguments += " --layer " + shell_word(reference.selection.layer);
    if (!reference.selection.part.empty())
        arguments += " --part " + shell_word(reference.selection.part);
    if (reference.format) arguments += fmt::format(" --format {}", format_name(*reference.format));
    if (reference.flip_v) arguments += " --flip-v";
    return arguments;
}

/// Equal for renders of one scene whose height map's file changes in between.
std::string baked_name(const Need& need) {
    const SamplerState& sampler = need.reference.sampler;
    return fmt::format("{} of {} {} {} {}", slot_name(need.slot),
                       bake_arguments(need.reference, source_of(need.slot)),
                       static_cast<int>(sampler.wrap_u), static_cast<int>(sampler.wrap_v),
                       fmt::join(sampler.border, " "));
}

/// What is derived from a height map, under the wrap modes that this is sampled with. Throws
/// InputError for a map that takes too long.
std::shared_ptr<const Texture> bake_need(const Scene& scene, const Need& need,
                                         const Texture& height, TextureCache& cache,
                                         const BakingListener& baking) {
    const std::string_view kind = slot_name(need.slot);
    BakedTextureOptions options;
    options.in_memory = is_quick_to_bake(bake_kind_from_name(kind));
    options.input = bake_arguments(need.reference, source_of(need.slot));
    options.key = need.reference.key;
    options.not_kept = baking.not_kept;
    options.seconds_limit = baking.seconds_limit;
    if (baking.progress)
        options.progress = [&, map = fmt::format("{} map", kind)](double share) {
            baking.progress(map, share);
        };
    try {
        auto map =
            baked_texture(height, bake_kind_from_name(kind), need.reference.sampler, options);
        cache.keep(baked_name(need), map);
        return map;
    } catch (const InputError& error) {
        throw InputError(scene.file.string(), error.key, error.found, error.expected);
    }
}

/// Solids between depth layers are told by their order: depths in [0, 1], none in front of the one
/// before. Looked at once for each content of the cache; not where the scene arranges channels
/// itself, as published listings want them.
void check_layer_order(const Scene& scene, const Need& need, const Texture& layers,
                       TextureCache& cache) {
    const TextureView& view = layers.view();
    const auto check = [&](const float* depths, int texel) {
        float before = 0;
        for (int c = 0; c < view.channels; ++c) {
            if (depths[c] < before || depths[c] > 1)
                throw InputError(
                    scene.file.string(), need.reference.key,
                    fmt::format("{}: depths {} at texel {},{}", need.reference.file.string(),
                                fmt::join(depths, depths + view.channels, ", "),
                                texel % view.width[0], texel / view.width[0]),
                    "depths in [0, 1], each at or behind the one before");
            if (depths[c] == depths[c]) before = depths[c];
        }
    };
    cache.range("order of layers " + layers.id(), [&] {
        const float* const texels = layers.level_texels(0, 0);
        for (int i = 0; i < view.width[0] * view.height[0]; ++i)
            check(texels + static_cast<std::ptrdiff_t>(i) * view.channels, i);
        return ValueRange{0, 1};
    });
}

}  // namespace

std::string height_swizzle(const TextureReference& reference) {
    return reference.swizzle.empty() ? "r" : reference.swizzle;
}

std::vector<MaterialTextures> load_textures(const Scene& scene, const std::vector<SlotSet>& slots,
                                            const std::vector<TexelsRead>& read,
                                            TextureCache& cache, const BakingListener& baking) {
    const std::vector<Need> needs = all_needs(scene, slots, read);
    std::vector<std::shared_ptr<const Texture>> loaded;
    std::vector<MaterialTextures> textures(slots.size());
    FirstError error;
    // On its own: where it runs within tasks that are cancelled, as by an error of one of them, it
    // would be left out without a word.
    tbb::task_group_context alone(tbb::task_group_context::isolated);
    tbb::parallel_invoke(
        [&] { error.run(0, [&] { loaded = load_all(needs, cache); }); },
        [&] { error.run(1, [&] { load_environment(scene, slots, cache, textures); }); }, alone);
    error.rethrow();
    cache.files().forget();
    for (std::size_t n = 0; n < needs.size(); ++n) {
        const Need& need = needs[n];
        MaterialTextures& out = textures[need.material];
        const auto i = static_cast<std::size_t>(need.slot);
        if (is_layers(need.slot) && need.reference.swizzle.empty())
            check_layer_order(scene, need, *loaded[n], cache);
        out.owned[i] =
            need.slot == TextureSlot::prewarp
                ? prewarp_for_view(scene, need.material, *loaded[n], need.reference.sampler, cache)
            : need.slot >= first_baked_slot ? bake_need(scene, need, *loaded[n], cache, baking)
                                            : loaded[n];
        out.sampled[i] = {out.owned[i]->view(), need.reference.sampler};
    }
    return textures;
}

}  // namespace quadrel
