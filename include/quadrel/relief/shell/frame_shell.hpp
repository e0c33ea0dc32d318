// frame-shell: the affine texture space of a tetrahedron of the shell over a mesh (shell_face.hpp).
// Objects of a material with this frame are drawn as shells: not the mesh's triangles but the faces
// by which rays enter, from any side; rays that leave without a hit show what is behind. The eye
// has to be outside of the shell.
//
// Inside of a tetrahedron
//     uv(P) = uv + J (P - P0),  s(P) = s + s_gradient . (P - P0).
// Rays may rise or run level in a shell: what other frames measure in depth (r, uv_rate, K,
// hit.depth) is measured along the ray, from where it enters: r = 1, uv_rate = J d. The searches
// that go with it are prism-*, and no others. Normals of heights and light rays start from
// frame_normal: `normal` says whether that is the vertices', interpolated over the face by which
// the ray enters, so that shading is as smooth as over the mesh; or -D s_gradient, which is 1 long
// where the shell is as thick as D says: what they want of an affine texture space, exactly, but it
// jumps from one tetrahedron to the next.
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

    struct Params {
        std::int32_t normal = 0;
    };
    static constexpr ValueName normal_names[] = {{0, "vertex"}, {1, "level"}};
    static constexpr std::array parameters{choice<&Params::normal>(
        "normal", "vertex: interpolated, smooth; level: across the planes of equal height",
        normal_names, 0)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
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
        const vec3<F> smooth = normalize(io.template load<Value::vertex_normal>());
        const vec3<F> level = select(deep, face.s_gradient() * -depth, smooth);
        io.template store<Value::frame_normal>(params.normal == 0 ? smooth : level);
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
