// What look-ups in a height map can give at most and at least.
#pragma once

#include <optional>
#include <string>

#include "quadrel/texture/texture_cache.hpp"

namespace quadrel {

/// Bounds of channel 0 under the sampler, over all levels that it may read and the border colour if
/// it may read that; rounding of the filters included. Equal where every look-up gives these very
/// bits. None for cube maps and where a bound would not be finite.
std::optional<ValueRange> height_range(const SampledTexture& map);

/// The same of a texture of this id (Texture::id), measured once and kept in the cache.
std::optional<ValueRange> height_range(const SampledTexture& map, const std::string& id,
                                       TextureCache& cache);

}  // namespace quadrel
