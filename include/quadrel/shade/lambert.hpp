// shade-lambert: matte. J. H. Lambert, "Photometria", 1760: light goes with the cosine alone.
//
// Source of maps, lights and terms: lit.hpp. The specular term is 0; a gloss map is not read.
#pragma once

#include "quadrel/shade/lit.hpp"

namespace quadrel {

struct ShadeLambert : LitDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-lambert", "shade", "matte reflection by the cosine",
                                    "Lambert, Photometria (1760)"};
    static constexpr auto textures = slots(TextureSlot::color, TextureSlot::emissive);

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        shade_lit(
            io, io.template load<Value::N>(), [](const vec3<F>&, F) { return NoHighlight(); },
            params.gradients);
    }
};

}  // namespace quadrel
