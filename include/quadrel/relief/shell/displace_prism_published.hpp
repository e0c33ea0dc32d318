// displace-prism@published: where a hit of prism-gs@published lies in space.
//
// Source: prism_strip.hpp, main: view_pos_displ = objPosEs + tbnMat * tex_offst / invmax, by the
// matrix at the fragment. gl_FragDepth is that point's (frag-depth).
#pragma once

#include "quadrel/relief/shell/prism_strip.hpp"

namespace quadrel {

struct DisplacePrismPublished : StageDefaults {
    static constexpr StageText text{"displace-prism@published", "hit",
                                    "the hit in a prism as a point in eye space, as listed",
                                    "Rabbid76, graphics-snippets, parallax_010"};
    static constexpr auto inputs = values_and(prism_strip_inputs, Value::hit_uv, Value::hit_h);
    static constexpr auto outputs = values(Value::hit_P);
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const PrismStripVaryings<F> in(io);
        const vec3<F> at(io.template load<Value::hit_uv>(), io.template load<Value::hit_h>());
        io.template store<Value::hit_P>(in.objPosEs + in.displ_vec(at - in.texCoords));
    }
};

}  // namespace quadrel
