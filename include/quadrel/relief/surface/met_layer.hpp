// The depth layer that a ray has met: the one whose depth at the hit, bilinear at level 0, is next
// to the hit's; the first of equal ones. Fronts, the odd layers, face out of the relief, backs into
// it.
#pragma once

#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

template <Number F>
struct MetLayer {
    F distance = F(std::numeric_limits<Scalar<F>>::infinity());  ///< from its depth to the hit's
    vec2<F> slope = vec2<F>(F(0));                               ///< of depths, along u and v
    Mask<F> is_back = Mask<F>(false);

    /// Takes what is nearer of a map's layers.
    void look_at(const SampledTexture& map, const SampleContext<F>& context, const vec2<F>& uv,
                 F s) {
        const Footprint<F> at = address(map, level_geometry<F>(map.view, 0), uv, Filter::linear);
        const F f = at.x.weight, g = at.y.weight;
        const vec2<F> texels = TexelSize<F>(map).texels;
        for (int layer = 0; layer < 4; ++layer) {
            const vec4<F> d = corners(map, context, uv, layer);
            const F d01 = d.x, d11 = d.y, d10 = d.z, d00 = d.w;
            const F from_hit = abs(lerp(lerp(d00, d10, f), lerp(d01, d11, f), g) - s);
            const Mask<F> nearer = from_hit < distance;
            distance = select(nearer, from_hit, distance);
            const vec2<F> steps(lerp(d10 - d00, d11 - d01, g), lerp(d01 - d00, d11 - d10, f));
            slope = select(nearer, steps * texels, slope);
            is_back = layer % 2 == 0 ? is_back & !nearer : is_back | nearer;
        }
    }

  private:
    /// In the order of textureGather; of a map of two channels, no second pair.
    static vec4<F> corners(const SampledTexture& map, const SampleContext<F>& context,
                           const vec2<F>& uv, int layer) {
        return layer < map.view.channels ? texture_gather(map, context, uv, layer) : vec4<F>(F(1));
    }
};

}  // namespace quadrel
