// What the judgement of a hit asks of depth layers (relief/trace/layer/layers.hpp): in double, on
// level 0 under the sampler's wrap modes, and not proven.
#pragma once

#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel {

/// Of the layer that a ray has met: its slope, and what s moves by where its depth does.
struct LayerSlope {
    double gradient_u = 0, gradient_v = 0;  ///< d depth / d(u, v)
    double condition = 0;                   ///< |ds / d depth|; 0 where s is 0, or on a wall
};

/// Of the first `layers` of the map, the one next to s at (u, v).
LayerSlope layer_slope(const SampledTexture& map, int layers, const oracle::Ray& ray, double u,
                       double v, double s);

/// Whether the ray is outside of all solids of the first `layers` over more than 2^-20 of the
/// relief's depth, anywhere at s in [from, to], which is clipped to [0, 1]. After 2^16 cells the
/// answer is no.
bool leaves_layers(const SampledTexture& map, int layers, const oracle::Ray& ray, double from,
                   double to);

}  // namespace quadrel
