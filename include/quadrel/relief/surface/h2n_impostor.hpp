// h2n-impostor: the exact normal of the layer that is met, of all three maps of an impostor.
//
// E. Risser, "True Impostors", GPU Gems 3, 2007, chapter 21, reads normals of each layer from
// textures; here they are the slopes of the layers themselves, as for h2n-layers.
#pragma once

#include "quadrel/relief/surface/met_layer.hpp"

namespace quadrel {

struct H2nImpostor : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"h2n-impostor", "surface",
                                    "exact normal of the layer that is met, of twelve",
                                    "after Risser 2007, GPU Gems 3, chapter 21"};
    static constexpr auto inputs = met_layer_inputs;
    static constexpr auto outputs = surface_outputs;
    static constexpr auto textures =
        slots(TextureSlot::layers, TextureSlot::layers_2, TextureSlot::layers_3);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        store_met_normal<TextureSlot::layers, TextureSlot::layers_2, TextureSlot::layers_3>(io);
    }
};

}  // namespace quadrel
