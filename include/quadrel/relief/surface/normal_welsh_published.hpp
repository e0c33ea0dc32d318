// normal-welsh@published: the normal of the map as the paper's fragment program has it.
//
// Source: T. Welsh, "Parallax Mapping with Offset Limiting" (2004), appendix: `TEX normal,
// newtexcoord`, scale and bias removed, normalised. It stays in tangent space there; here it is
// handed on along the frame's T, B and normal as they are, so that shade-welsh@published finds the
// program's numbers again. The look-up takes the implicit derivatives of the displaced coordinate.
// Without a map: the frame's normal.
#pragma once

#include "quadrel/relief/surface/tangent_normal.hpp"

namespace quadrel {

/// What normals of a map in tangent space load that are handed on along T, B and the normal.
inline constexpr auto listed_normal_inputs =
    values(Value::T, Value::B, Value::frame_normal, Value::hit_uv);

/// Stores x T + y B + z (frame normal), not normalised.
template <class Io, class F = typename Io::Number>
void store_along_frame(const Io& io, const vec3<F>& n) {
    io.template store<Value::N>(io.template load<Value::T>() * n.x +
                                io.template load<Value::B>() * n.y +
                                io.template load<Value::frame_normal>() * n.z);
}

struct NormalWelshPublished : NormalFromMap {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"normal-welsh@published", "surface",
                                    "normal of the map in tangent space, normalised",
                                    "Welsh, Parallax Mapping with Offset Limiting (2004)"};
    static constexpr auto inputs = listed_normal_inputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SampledTexture* map = io.template texture<TextureSlot::normal>();
        if (!map) return io.template store<Value::N>(io.template load<Value::frame_normal>());
        // TEX normal, newtexcoord, texture[1], 2D; MAD normal, normal, 2.0, -1.0
        const vec2<F> newtexcoord = io.template load<Value::hit_uv>();
        const vec3<F> normal =
            signed_texel(implicit_texel<TextureSlot::normal>(io, *map, newtexcoord));
        // DP3 temp, normal, normal; RSQ temp, temp.r; MUL normal, normal, temp
        store_along_frame(io, normalize(normal));
    }
};

}  // namespace quadrel
