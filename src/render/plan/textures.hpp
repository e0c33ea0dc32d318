// The textures that a render needs, loaded once each.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/texture/texture_cache.hpp"
#include "render/plan/plan.hpp"
#include "render/plan/texels_read.hpp"

namespace quadrel {

/// A material's textures, by slot; null where it has none or no stage reads it.
struct MaterialTextures {
    std::array<std::shared_ptr<const Texture>, texture_slot_count> owned;
    std::array<SampledTexture, texture_slot_count> sampled{};
    /// The slot's binding, or null.
    const SampledTexture* bound(int slot) const { return owned[slot] ? &sampled[slot] : nullptr; }
};

/// Who is told of what is derived from heights, each may be none, and how long that may take.
struct BakingListener {
    /// How much of it is done.
    std::function<void(const std::string& map, double share)> progress;
    /// Why the disk cache does not keep it.
    std::function<void(const std::string& reason)> not_kept;
    double seconds_limit = 20;  ///< for one map
};

/// Which channel of its file holds a material's heights, as a swizzle: the first unless the scene
/// says otherwise.
std::string height_swizzle(const TextureReference& reference);

/// Loads of each material the textures that are in its set of slots, from `cache` where that has
/// them, and keeps them there; of these what `read` says, at least.
std::vector<MaterialTextures> load_textures(const Scene& scene, const std::vector<SlotSet>& slots,
                                            const std::vector<TexelsRead>& read,
                                            TextureCache& cache, const BakingListener& baking);

}  // namespace quadrel
