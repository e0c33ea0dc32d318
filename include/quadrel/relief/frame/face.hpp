// frame-face: J of the triangle itself, from its vertices; the judge of the other frames.
//
// Over one triangle UV is an affine function of position, so that its three vertices determine J:
// with edges e1, e2, UV edges d1, d2 and n = e1 x e2,
//     J w = d1 ((w x e2).n) / n^2 + d2 ((e1 x w).n) / n^2
// (the per-triangle solve of F. Policarpo, M. Oliveira and J. Comba, "Real-Time Relief Mapping on
// Arbitrary Polygonal Surfaces", 2005, inverted). The host does that in double and hands on J
// rounded to float: no derivative of a quad enters, and nothing depends on the camera but the view
// ray. Depth and facing are those of frame-gram; split.hpp explains `split`.
//
// NOFRAME where the triangle has no area or the ray does not enter the surface; a UV map of rank 0
// or 1 is rendered and flagged.
#pragma once

#include "quadrel/relief/frame/split.hpp"

namespace quadrel {

struct FrameFace : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"frame-face", "frame",
                                    "J of the triangle from its vertices, in double",
                                    "Policarpo, Oliveira and Comba 2005, solved a triangle"};
    static constexpr auto inputs =
        values(Value::P, Value::vertex_normal, Value::Ng, Value::face_J, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;
    using Params = SplitParams;
    static constexpr auto parameters = split_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const auto J = io.template load<Value::face_J>();
        const vec3<F> face_normal = io.template load<Value::Ng>();
        const Mask<F> has_area = dot(face_normal, face_normal) > F(0);
        store_split_frame(
            io, SurfaceJacobian<F>{J[0], J[1], has_area, gradients_degenerate(J[0], J[1])}, params);
    }
};

}  // namespace quadrel
