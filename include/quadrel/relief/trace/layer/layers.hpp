// Depth layers: solids between pairs of depth maps, so that a ray may pass behind things and miss.
//
//     texel = (front, back, second front, second back), depths as s: 0 top plane, 1 bottom plane,
//     solid where front <= s < back of either pair.
//
// Layers are sorted, so that what is between the second back of a texel and its first front is one
// solid or two. Where front and back are equal there is nothing; bilinear interpolation closes a
// solid towards such texels. Of layers that are sorted, s is inside of a pair exactly if an odd
// number of depths is at or above it (Policarpo and Oliveira 2006). Layers that a map lacks are at
// the bottom: one of two channels has one pair, and one of a single channel is solid below it.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// The material's depth layers.
template <class Io>
const SampledTexture& layer_map(const Io& io) {
    return *io.template texture<TextureSlot::layers>();
}

/// The layers of what a look-up gives: those that the map lacks are at the bottom.
template <Number F>
vec4<F> layer_depths(const SampledTexture& map, const vec4<F>& texel) {
    if (map.view.channels == 4) return texel;
    return {texel.x, map.view.channels == 1 ? F(1) : texel.y, F(1), F(1)};
}

/// Whether an odd number of the first `layers` depths is at or above s.
template <int layers, Number F>
Mask<F> is_inside(const vec4<F>& depths, F s) {
    Mask<F> inside(false);
    for (int layer = 0; layer < layers; ++layer) {
        const Mask<F> behind = depths[layer] <= s;
        inside = (inside & !behind) | (behind & !inside);
    }
    return inside;
}

/// The depth that is next to s; the first of equal ones.
template <int layers, Number F>
F nearest_layer(const vec4<F>& depths, F s) {
    F nearest = depths[0];
    for (int layer = 0; layer < layers; ++layer) {
        const Mask<F> nearer = abs(depths[layer] - s) < abs(nearest - s);
        nearest = select(nearer, depths[layer], nearest);
    }
    return nearest;
}

/// Whether one of the first `layers` depths is not a number.
template <int layers, Number F>
Mask<F> has_nan(const vec4<F>& depths) {
    Mask<F> nan(false);
    for (int layer = 0; layer < layers; ++layer) nan = nan | is_nan(depths[layer]);
    return nan;
}

}  // namespace quadrel
