// shade-layers: a colour map for each depth layer; the highlight is Blinn's.
//
// Source: F. Policarpo, M. M. Oliveira, "Relief Mapping of Non-Height-Field Surface Details", I3D
// 2006, whose layers may have colours of their own, as they have normals. Normals are packed there,
// a channel a layer (normal-layers); colours have three channels themselves, so that each layer has
// a map, with a size, wrap modes and filters of its own: `color` is the first front's, `color_2` to
// `color_4` those of the layers behind it. A layer without a map has that of `color`. Which layer a
// ray has met is decided as for h2n-layers (met_layer.hpp). Opacity, too, is the layer's own.
//
// Lights, terms and the other maps: lit.hpp; the highlight: blinn_phong.hpp.
#pragma once

#include "quadrel/relief/surface/met_layer.hpp"
#include "quadrel/shade/blinn_phong.hpp"

namespace quadrel {

struct ShadeLayers : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-layers", "shade",
                                    "colours of the layer that is met, Blinn's highlight",
                                    "after Policarpo and Oliveira 2006"};
    static constexpr auto inputs =
        values_and(lit_inputs, Value::hit_s, Value::K, Value::frame_normal, Value::r);
    static constexpr auto textures =
        slots(TextureSlot::color, TextureSlot::gloss, TextureSlot::emissive, TextureSlot::layers,
              TextureSlot::color_2, TextureSlot::color_3, TextureSlot::color_4);
    static constexpr bool reads_first_gloss_only = true;  // the exponent

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        MetLayer<F> met;
        look_at_slot<TextureSlot::layers>(io, met, way_down(io));
        vec4<F> base = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)), params.gradients);
        take<TextureSlot::color_2>(io, met.index == Int<F>(1), params.gradients, base);
        take<TextureSlot::color_3>(io, met.index == Int<F>(2), params.gradients, base);
        take<TextureSlot::color_4>(io, met.index == Int<F>(3), params.gradients, base);
        const LitPoint<F> at = lit_point(io, params.gradients);
        shade_lit(
            io, base, at.N, [&](const vec3<F>& L, F) { return blinn_highlight(at, L); },
            params.gradients);
    }

  private:
    /// A layer's own colour, where that layer is met and has a map.
    template <TextureSlot slot, class Io, class F = typename Io::Number>
    static void take(Io& io, Mask<F> here, std::int32_t gradients, vec4<F>& base) {
        base = select(here, map_at_hit<slot>(io, base, gradients), base);
    }
};

}  // namespace quadrel
