// frame-prism@published: the texture space of prisms that a geometry shader makes, as listed.
// Objects of a material with this frame are drawn as the triangles that it emits, with the faces
// that the material culls; the mesh is the relief's bottom (seat 0).
//
// Source: prism_strip.hpp. J is what the listing's inverse matrix has: u and v by the world's
// lengths. It is that of the surface only where a triangle is half of the texture (or where a
// triangle's sides are as long in the texture as those of one that is), and along its axes: else
// off by the ratio of the areas, and turned as frame-inverse-tbn@published is. r is 1, and
// uv_rate = J d; K is the listing's tbnStep.xy, the shift while heights fall, or rise, by 1.
// Depth is the listing's scale, in world units; below 0.001 nothing is displaced.
#pragma once

#include "quadrel/relief/shell/prism_strip.hpp"

namespace quadrel {

/// tbnDir, scaled to a height of 1; on sides no further than twice its shift (xy), which leaves
/// flat rays short of that height.
template <Number F>
vec3<F> prism_strip_step(const vec3<F>& tbnDir, Mask<F> is_silhouette) {
    const F rise = abs(tbnDir.z), shift = F(0.5f) * length(vec2<F>(tbnDir.x, tbnDir.y));
    const vec3<F> texDist = tbnDir / select(is_silhouette, max(rise, shift), rise);
    return {texDist.x, texDist.y, sign(tbnDir.z)};
}

/// Whether a fragment lies on a side of the prism.
template <Number F>
Mask<F> is_prism_silhouette(const vec3<F>& texCoords) {
    return texCoords.z > F(0.0001f);
}

struct FramePrismPublished : StageDefaults {
    static constexpr StageText text{"frame-prism@published", "frame",
                                    "matrix of scaled gradients in prisms, as listed",
                                    "Rabbid76, graphics-snippets, parallax_010"};
    static constexpr auto inputs =
        values_and(prism_strip_inputs, Value::vertex_normal, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const PrismStripVaryings<F> in(io);
        const vec3<F> N = normalize(io.template load<Value::vertex_normal>()) * in.frontFace;
        const vec3<F> d = -to_viewer(in.objPosEs, io.frame());
        const Mask<F> deep = io.template load<Value::relief_depth>() > F(0);
        const vec3<F> third = select(deep, in.tbnMat[2], N * in.invmax);
        const mat3<F> rows = transpose(inverse(mat3<F>(in.tbnMat[0], in.tbnMat[1], third)));
        const vec3<F> grad_u = rows[0] * in.invmax, grad_v = rows[1] * in.invmax;
        const vec3<F> step = prism_strip_step(in.tbnDir, is_prism_silhouette(in.texCoords));
        io.template store<Value::T>(in.tbnMat[0]);
        io.template store<Value::B>(in.tbnMat[1]);
        io.template store<Value::frame_normal>(N);
        io.template store<Value::J>(std::array<vec3<F>, 2>{grad_u, grad_v});
        io.template store<Value::r>(F(1));
        io.template store<Value::uv_rate>(vec2<F>(dot(grad_u, d), dot(grad_v, d)));
        const Mask<F> on(rabbid_displaces(io.material()));
        io.template store<Value::K>(select(on, vec2<F>(step.x, step.y), vec2<F>(F(0))));
        io.template store<Value::frame_status>(status_packet<F>(Status::hit));
        io.template store<Value::frame_flags>(Int<F>(0));
    }
};

}  // namespace quadrel
