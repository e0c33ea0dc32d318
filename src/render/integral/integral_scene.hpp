// The scene whose shading an integral over pixels takes samples of.
#pragma once

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// The scene with all in the judge's terms that a pixel's footprint would otherwise decide:
///   - the judge's first hit in the place of what the material's trace finds: of blocks where that
///     searches maxima of texels, else of bilinear patches; traces of the judge stay, and none;
///   - bump-blinn, whose differences are those of pixels, as their limit: h2n-patch;
///   - textures and the environment filtered bilinearly, at level 0, with exact weights;
///   - exact hardware, no multisampling.
/// Frames stay: on a plane their differences give the same whatever the distance. Throws InputError
/// where a trace searches noise, of which the judge knows nothing.
Scene integral_scene(const Scene& scene);

}  // namespace quadrel
