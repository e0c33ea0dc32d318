// frame-shell: the affine texture space of a tetrahedron of the shell over a mesh (shell_face.hpp).
// Objects of a material with this frame are drawn as shells: not the mesh's triangles but the faces
// by which rays enter, from any side; rays that leave without a hit show what is behind. The eye
// has to be outside of the shell.
//
// Inside of a tetrahedron
//     uv(P) = uv + J (P - P0),  height(P) = height - s_gradient . (P - P0),
// so that frame_normal is -D s_gradient: of length 1 where the shell is as thick as D says, as over
// a flat mesh, and exactly what normals of heights and light rays want of it everywhere else: they
// go on in the tetrahedron's own texture space. Rays may rise or run level in a shell: what other
// frames measure in depth (r, uv_rate, K, hit.depth) is measured along the ray, from where it
// enters: r = 1, uv_rate = J d. The searches that go with it are prism-*, and no others.
//
// Source: Hirche et al., "Hardware Accelerated Per-Pixel Displacement Mapping", 2004. Differs:
// gradients are the host's, in double, and reach every fragment as a row of its face.
//
// Of depth 0 the mesh itself is drawn: uv and normal are the surface's own.
#pragma once

#include "quadrel/relief/frame/store.hpp"
#include "quadrel/relief/shell/shell_face.hpp"

namespace quadrel {

struct FrameShell : StageDefaults {
    static constexpr StageText text{"frame-shell", "frame",
                                    "affine texture space of the tetrahedra of a shell",
                                    "Hirche, Ehlert, Guthe, Doggett 2004"};
    static constexpr auto inputs = values(Value::P, Value::vertex_normal, Value::relief_depth);
    static constexpr auto outputs = frame_outputs;
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ShellFaces<F> face(io);
        const vec3<F> d = -to_viewer(io.template load<Value::P>(), io.frame());
        const F depth = io.template load<Value::relief_depth>();
        const Mask<F> yes(true), deep = depth > F(0);
        const SurfaceJacobian<F> j{face.grad_u(), face.grad_v(), yes,
                                   gradients_degenerate(face.grad_u(), face.grad_v())};
        const vec2<F> rate(dot(j.grad_u, d), dot(j.grad_v, d));
        const auto directions = uv_directions(j);
        io.template store<Value::T>(directions.T);
        io.template store<Value::B>(directions.B);
        io.template store<Value::frame_normal>(select(
            deep, face.s_gradient() * -depth, normalize(io.template load<Value::vertex_normal>())));
        io.template store<Value::J>(std::array<vec3<F>, 2>{j.grad_u, j.grad_v});
        io.template store<Value::r>(F(1));
        io.template store<Value::uv_rate>(rate);
        io.template store<Value::K>(rate * depth);
        io.template store<Value::frame_status>(status_packet<F>(Status::hit));
        io.template store<Value::frame_flags>(
            select(j.uv_degenerate, Int<F>(HitFlag::uv_degenerate), Int<F>(0)));
    }
};

}  // namespace quadrel
