// The depth layer that a ray has met: the one whose depth at the hit, bilinear at level 0, is next
// to the hit's; the first of equal ones. Fronts, the odd layers, face out of the relief, backs into
// it: their normal is turned around.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

template <Number F>
struct MetLayer {
    F distance = F(std::numeric_limits<Scalar<F>>::infinity());  ///< from its depth to the hit's
    vec2<F> slope = vec2<F>(F(0));                               ///< of depths, along u and v
    Mask<F> is_back = Mask<F>(false);
    Int<F> index = Int<F>(0);  ///< from 0, in its map

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
            index = select(nearer, Int<F>(layer), index);
        }
    }

  private:
    /// In the order of textureGather; of a map of two channels, no second pair.
    static vec4<F> corners(const SampledTexture& map, const SampleContext<F>& context,
                           const vec2<F>& uv, int layer) {
        return layer < map.view.channels ? texture_gather(map, context, uv, layer) : vec4<F>(F(1));
    }
};

/// What the normal of a met layer is made of.
inline constexpr auto met_layer_inputs = values_and(relief_normal_inputs, Value::hit_s);

/// Takes what is nearer of a slot's map, if there is one.
template <TextureSlot slot, class Io, class F>
void look_at_slot(const Io& io, MetLayer<F>& met) {
    const SampledTexture* const map = io.template texture<slot>();
    if (map == nullptr) return;
    met.look_at(*map, io.template context<slot>(), io.template load<Value::hit_uv>(),
                io.template load<Value::hit_s>());
}

/// Stores the normal of the nearest layer of the maps in these slots; one without a map has none.
template <TextureSlot... layers, class Io>
void store_met_normal(Io& io) {
    using F = typename Io::Number;
    const F depth = io.template load<Value::relief_depth>();
    const Mask<F> deep = depth != F(0);
    vec3<F> n(F(0));
    if (when(deep)) {
        MetLayer<F> met;
        (look_at_slot<layers>(io, met), ...);
        const vec3<F> up = relief_normal<Io, F>(io, -met.slope, depth);
        n = select(deep, select(met.is_back, -up, up), n);
    }
    store_normal(io, n, deep);
}

}  // namespace quadrel
