// h2n-layers: the exact normal of the depth layer that a ray has met.
//
// Policarpo and Oliveira 2006 keep normals of four layers in two textures; here they are the slopes
// of the layers themselves. Fronts, the odd layers, face out of the relief, backs into it: their
// normal is turned around.
#pragma once

#include "quadrel/relief/surface/met_layer.hpp"

namespace quadrel {

struct H2nLayers : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"h2n-layers", "surface",
                                    "exact normal of the layer that is met",
                                    "after Policarpo and Oliveira 2006"};
    static constexpr auto inputs = met_layer_inputs;
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        store_met_normal<TextureSlot::layers>(io);
    }
};

}  // namespace quadrel
