// The relief texture of a material, warped for a scene's view.
#pragma once

#include <memory>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Of the height map `height`, under the wrap modes of `sampler`: over the rectangle of texture
/// space that the material's visible polygons cover, rounded outwards to texels. Taken from
/// `cache`, which keeps the last one of each material, where nothing that it depends on has
/// changed. Throws InputError where the material's polygons are not of one plane with one affine
/// UV, its relief fades, or the rectangle has more than 2^24 texels.
std::shared_ptr<const Texture> prewarp_for_view(const Scene& scene, std::size_t material,
                                                const Texture& height, const SamplerState& sampler,
                                                TextureCache& cache);

}  // namespace quadrel
