// h2n-layers: the exact normal of the depth layer that a ray has met.
//
// Policarpo and Oliveira 2006 keep normals of four layers in two textures; here they are the slopes
// of the layers themselves. Fronts, the odd layers, face out of the relief, backs into it: their
// normal is turned around.
#pragma once

#include "quadrel/relief/surface/met_layer.hpp"
#include "quadrel/relief/surface/relief_normal.hpp"

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
            MetLayer<F> met;
            met.look_at(layer_map(io), io.template context<TextureSlot::layers>(),
                        io.template load<Value::hit_uv>(), io.template load<Value::hit_s>());
            const vec3<F> up = relief_normal<Io, F>(io, -met.slope, depth);
            n = select(deep, select(met.is_back, -up, up), n);
        }
        store_normal(io, n, deep);
    }
};

}  // namespace quadrel
