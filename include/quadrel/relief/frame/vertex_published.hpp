// frame-vertex@published: the tangent-space eye vector of the vertices, as Welsh has it.
//
// Source: T. Welsh, "Parallax Mapping with Offset Limiting", 2004, 4.2 and 7. His vertex program
// takes the vector to the eye in object space times tangent, binormal and normal, not normalised;
// the fragment program normalises what is interpolated and moves the texture coordinate by
// height * V_t, over V_t.z in the listing of 4.2. Here
//     K = -Du V_t.xy * (1 / V_t.z),
// the shift while height falls by one; Du, his scale 0.04, is the material's depth, a length in UV:
// give it as {"thickness", "tile"}, which is how he defines it. His bias is the material's seat,
// sigma = -bias / scale, 0.5 with his numbers.
//
// Unit vectors say nothing of the UV map's density: maps of other than square tiles shift by the
// wrong amount, sheared ones in the wrong direction as well (frame-vertex corrects the first). T
// and B are the vertices' unit tangent and binormal in eye space, interpolated and normalised; the
// listing has no use for them.
#pragma once

#include "quadrel/relief/frame/published.hpp"
#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

struct FrameVertexPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frame-vertex@published", "frame",
                                    "tangent-space eye vector of the vertices, unit tangents",
                                    "Welsh, Parallax Mapping with Offset Limiting, 2004, 4.2, 7"};
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        // DP3 temp, t, t; RSQ temp, temp.x; MUL eyevecs, t, temp
        const vec3<F> V_t = normalize(vertex_eye(io));
        const UvDirections<F> axes = vertex_axes(io);
        const Mask<F> yes(true);
        // RCP temp, eyevecs.z; MUL height, height, temp; MAD newtexcoord, height, eyevecs, texcoord
        const F per_height = F(io.material().depth) * (F(1) / V_t.z);
        const vec2<F> K = -(vec2<F>(V_t.x, V_t.y) * per_height);
        store_published_frame(io, axes, surface.N, SurfaceJacobian<F>{axes.T, axes.B, yes, !yes},
                              V_t.z, K);
    }

  private:
    template <class Io, class F = typename Io::Number>
    static UvDirections<F> vertex_axes(const Io& io) {
        const VertexProgram program(io);
        const auto direction = [&](vec3<F> Vertex<F>::*axis) {
            return normalize(program.varying(
                [&](const Vertex<F>& vertex) { return program.vector_to_eye(vertex.*axis); }));
        };
        return {direction(&Vertex<F>::tangent), direction(&Vertex<F>::binormal)};
    }
};

}  // namespace quadrel
