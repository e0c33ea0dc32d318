// Maxima of a height map for searches that leave out steps: made when a render starts, in a small
// part of the time that reading the map takes, and kept with it.
#pragma once

#include <memory>
#include <vector>

#include "quadrel/texture/height_maxima.hpp"
#include "quadrel/texture/texture.hpp"

namespace quadrel {

/// The bounds of a height map, owned.
struct OwnedMaxima {
    HeightMaxima maxima{};
    std::vector<std::shared_ptr<const Texture>> textures;  ///< two for each mip level
    int made = 0;                                          ///< of them; memory had the others
    double wall_ms = 0;                                    ///< that making them took

    std::size_t bytes() const;
};

/// Those of all mip levels that the sampler may read, from memory while somebody holds them. Null
/// for cube maps. May be called from several threads; works in parallel.
std::shared_ptr<const OwnedMaxima> height_maxima(const Texture& map, const SamplerState& sampler);

}  // namespace quadrel
