// The textures that a render needs, loaded once each.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/texture/texture_cache.hpp"
#include "render/plan.hpp"

namespace quadrel {

/// A material's textures, by slot; null where it has none or no stage reads it.
struct MaterialTextures {
    std::array<std::shared_ptr<const Texture>, texture_slot_count> owned;
    std::array<SampledTexture, texture_slot_count> sampled{};
    /// The slot's binding, or null.
    const SampledTexture* bound(int slot) const { return owned[slot] ? &sampled[slot] : nullptr; }
};

/// Told what is derived from heights and how much of it is done; may be none.
using BakingProgress = std::function<void(const std::string& map, double share)>;
/// Which channel of its file holds a material's heights, as a swizzle: the first unless the scene
/// says otherwise.
std::string height_swizzle(const TextureReference& reference);

/// Loads those of the material's textures that are in `slots`.
MaterialTextures load_textures(const Scene& scene, const Material& material, const SlotSet& slots,
                               TextureCache& cache, const BakingProgress& baking);

}  // namespace quadrel
