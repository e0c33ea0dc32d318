// h2n-layers: the exact normal of the depth layer that a ray has met.
//
// Policarpo and Oliveira 2006 keep normals of four layers in two textures; here they are the slopes
// of the layers themselves. The layer is the one whose depth at the hit, bilinear at level 0, is
// next to the hit's; the first of equal ones. Fronts, the odd layers, face out of the relief, backs
// into it: their normal is turned around.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"
#include "quadrel/relief/trace/layer/layers.hpp"

namespace quadrel {

struct H2nLayers : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"h2n-layers", "surface",
                                    "exact normal of the layer that is met",
                                    "after Policarpo and Oliveira 2006"};
    static constexpr auto inputs = values_and(relief_normal_inputs, Value::hit_s);
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const F depth = io.template load<Value::relief_depth>();
        const Mask<F> deep = depth != F(0);
        vec3<F> n(F(0));
        if (when(deep)) {
            const MetLayer<F> met = met_layer(io);
            const vec3<F> up = relief_normal<Io, F>(io, -met.slope, depth);
            n = select(deep, select(met.is_back, -up, up), n);
        }
        store_normal(io, n, deep);
    }

  private:
    /// In the order of textureGather; of a map of two channels, no second pair.
    template <class F>
    static vec4<F> corners_of_layer(const SampledTexture& map, const SampleContext<F>& context,
                                    const vec2<F>& uv, int layer) {
        return layer < map.view.channels ? texture_gather(map, context, uv, layer) : vec4<F>(F(1));
    }
    template <Number F>
    struct MetLayer {
        vec2<F> slope;  ///< of depths, along u and v
        Mask<F> is_back;
    };

    template <class Io, class F = typename Io::Number>
    static MetLayer<F> met_layer(const Io& io) {
        const SampledTexture& map = layer_map(io);
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const F s = io.template load<Value::hit_s>();
        const SampleContext<F> context = io.template context<TextureSlot::layers>();
        const Footprint<F> at = address(map, level_geometry<F>(map.view, 0), uv, Filter::linear);
        const F f = at.x.weight, g = at.y.weight;
        MetLayer<F> met{vec2<F>(F(0)), Mask<F>(false)};
        F nearest(std::numeric_limits<Scalar<F>>::infinity());
        for (int layer = 0; layer < 4; ++layer) {
            const vec4<F> d = corners_of_layer(map, context, uv, layer);
            const F d01 = d.x, d11 = d.y, d10 = d.z, d00 = d.w;
            const F distance = abs(lerp(lerp(d00, d10, f), lerp(d01, d11, f), g) - s);
            const Mask<F> nearer = distance < nearest;
            nearest = select(nearer, distance, nearest);
            const vec2<F> slope(lerp(d10 - d00, d11 - d01, g), lerp(d01 - d00, d11 - d10, f));
            met.slope = select(nearer, slope, met.slope);
            met.is_back = layer % 2 == 0 ? met.is_back & !nearer : met.is_back | nearer;
        }
        met.slope = met.slope * TexelSize<F>(map).texels;
        return met;
    }
};

}  // namespace quadrel
