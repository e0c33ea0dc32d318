// What look-ups in a height map can give at most and at least.
#pragma once

#include <optional>
#include <string>

#include "quadrel/texture/view.hpp"

namespace quadrel {

/// Inclusive; equal where every look-up gives these very bits.
struct HeightRange {
    float low, high;
};

/// Bounds of channel 0 under the sampler, over all levels that it may read and the border colour if
/// it may read that; rounding of the filters included. None for cube maps and where a bound would
/// not be finite.
std::optional<HeightRange> height_range(const SampledTexture& map);

/// The same of a texture of this id (Texture::id), measured once in the life of the process.
std::optional<HeightRange> height_range(const SampledTexture& map, const std::string& id);

}  // namespace quadrel
