// h2n-impostor: the exact normal of the layer that is met, of all three maps of an impostor.
//
// E. Risser, "True Impostors", GPU Gems 3, 2007, chapter 21, reads normals of each layer from
// textures; here they are the slopes of the layers themselves, as for h2n-layers.
#pragma once

#include "quadrel/relief/surface/met_layer.hpp"
#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct H2nImpostor : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"h2n-impostor", "surface",
                                    "exact normal of the layer that is met, of twelve",
                                    "after Risser 2007, GPU Gems 3, chapter 21"};
    static constexpr auto inputs = values_and(relief_normal_inputs, Value::hit_s);
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures =
        slots(TextureSlot::layers, TextureSlot::layers_2, TextureSlot::layers_3);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const F depth = io.template load<Value::relief_depth>();
        const Mask<F> deep = depth != F(0);
        vec3<F> n(F(0));
        if (when(deep)) {
            MetLayer<F> met;
            look_at<TextureSlot::layers>(io, met);
            look_at<TextureSlot::layers_2>(io, met);
            look_at<TextureSlot::layers_3>(io, met);
            const vec3<F> up = relief_normal<Io, F>(io, -met.slope, depth);
            n = select(deep, select(met.is_back, -up, up), n);
        }
        store_normal(io, n, deep);
    }

  private:
    template <TextureSlot slot, class Io, class F>
    static void look_at(const Io& io, MetLayer<F>& met) {
        const SampledTexture* const map = io.template texture<slot>();
        if (map == nullptr) return;
        met.look_at(*map, io.template context<slot>(), io.template load<Value::hit_uv>(),
                    io.template load<Value::hit_s>());
    }
};

}  // namespace quadrel
