// frame-mikkt: the tangent space of glTF, Blender, Unity and Unreal.
//
// Source: M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008 (MikkTSpace). The
// vertices carry a unit tangent and a handedness (the mesh's own or those of scene/tangents.hpp); a
// fragment uses N and T as interpolated, not normalised, with
//     B = handedness cross(N, T),  shading normal = normalize(n.x T + n.y B + n.z N).
// All three are handed on divided by |N|, so that the frame's normal is a unit vector and the sum
// has the same direction: T and B of this frame are not unit vectors.
//
// It is a frame for normal maps, orthonormal by construction, which J is not: for the search T and
// B serve as directions alone, with |dP/du| and |dP/dv| of the triangle as density, and B turned to
// the side where v grows (glTF's bitangent points up the picture, against v). Sheared maps march in
// the wrong direction. Where the UV map is degenerate K = 0, flagged.
#pragma once

#include "quadrel/relief/frame/vertex.hpp"

namespace quadrel {

/// 1 / |dP/du| from the gradients of u and of the other coordinate; |grad u| where that is
/// constant.
template <Number F>
F inverse_density(const vec3<F>& grad, const vec3<F>& grad_other) {
    const F scale = ordinary_scale(grad, grad_other);
    const vec3<F> a = grad * scale, b = grad_other * scale;
    const F other = length(b);
    return select(other > F(0), length(cross(a, b)) / other, length(a)) / scale;
}

struct FrameMikkt : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frame-mikkt", "frame",
                                    "MikkTSpace: for normal maps; density of the triangle",
                                    "Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008"};
    // The bitangent's place holds the unit vertex normals (render/draw/primitive_frame.hpp).
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::vertex_tangent,
               Value::tangent_sign, Value::vertex_bitangent, Value::face_J, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ViewedSurface<F> surface = viewed_surface(io);
        const vec3<F> normal = io.template load<Value::vertex_bitangent>();
        const vec3<F> tangent = io.template load<Value::vertex_tangent>();
        const vec3<F> bitangent = cross(normal, tangent) * io.template load<Value::tangent_sign>();
        const F normal_length = length(normal);
        const UvDirections<F> axes{over_length(tangent, normal_length),
                                   over_length(bitangent, normal_length)};
        const auto face = io.template load<Value::face_J>();
        const vec3<F> B = tangent_direction(bitangent, surface.N);
        const F side = select(dot(B, face[1]) < F(0), F(-1), F(1));
        SurfaceJacobian<F> j;
        j.grad_u = tangent_direction(tangent, surface.N) * inverse_density(face[0], face[1]);
        j.grad_v = B * (side * inverse_density(face[1], face[0]));
        j.valid = Mask<F>(true);
        j.uv_degenerate = gradients_degenerate(face[0], face[1]);
        store_frame(io, surface, j, axes, dot(surface.V, surface.N));
    }
};

}  // namespace quadrel
