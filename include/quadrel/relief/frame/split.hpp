// How a frame splits a vector into surface part and depth where the vertex normal N is not the
// face's own normal Nf.
//
//     orthogonal   J projects onto the face plane along Nf, depth is the component along N:
//                  r = V.N. What the thesis and orthonormal tangent frames do.
//     oblique      w = w_face + a N; J w = J w_face, depth is a: r = (V.Nf) / (N.Nf). The one that
//                  agrees with a surface displaced along the interpolated N.
//
// Both are the same where N = Nf. The oblique r is positive on every front face, also where the
// interpolated normal looks away from the viewer, so that silhouettes keep their frame.
#pragma once

#include "quadrel/relief/frame/store.hpp"

namespace quadrel {

struct SplitParams {
    std::int32_t split = 0;
};

inline constexpr ValueName split_names[] = {{0, "orthogonal"}, {1, "oblique"}};

/// The parameter `split` of a stage whose Params are SplitParams.
inline constexpr std::array split_parameters{choice<&SplitParams::split>(
    "split", "orthogonal: depth along N, J along the face; oblique: J along N", split_names, 0)};

/// (V.Nf) / (N.Nf); 0, which is no frame, where N lies in the face or behind it.
template <Number F>
F oblique_depth_rate(const ViewedSurface<F>& surface, const vec3<F>& face_normal) {
    const F cosine = dot(surface.N, face_normal);
    const F r = dot(surface.V, face_normal) / cosine;
    return select(abs(cosine) > degenerate_tolerance<F>() * length(face_normal), r, F(0));
}

/// J of the face plane (J Nf = 0) as the one along N (J N = 0): equal for vectors in the face.
template <Number F>
SurfaceJacobian<F> oblique_jacobian(const SurfaceJacobian<F>& j, const vec3<F>& N,
                                    const vec3<F>& face_normal) {
    const F cosine = dot(N, face_normal);
    const Mask<F> crossing = abs(cosine) > degenerate_tolerance<F>() * length(face_normal);
    const vec3<F> along = select(crossing, face_normal / cosine, vec3<F>(F(0)));
    SurfaceJacobian<F> oblique = j;
    oblique.grad_u = j.grad_u - along * dot(j.grad_u, N);
    oblique.grad_v = j.grad_v - along * dot(j.grad_v, N);
    oblique.valid = j.valid & crossing;
    return oblique;
}

/// Stores the frame of a J that lies in the face plane, split as `params` say.
template <class Io, class F = typename Io::Number>
void store_split_frame(const Io& io, const SurfaceJacobian<F>& j, const SplitParams& params) {
    const ViewedSurface<F> surface = viewed_surface(io);
    if (params.split == 0) return store_frame(io, surface, j, dot(surface.V, surface.N));
    const vec3<F> face_normal = io.template load<Value::Ng>();
    store_frame(io, surface, oblique_jacobian(j, surface.N, face_normal),
                oblique_depth_rate(surface, face_normal));
}

}  // namespace quadrel
