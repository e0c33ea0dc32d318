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

#include "quadrel/relief/shell/shell_face.hpp"
#include "quadrel/relief/shell/shell_frame.hpp"

namespace quadrel {

struct FrameShell : ShellFrame {
    static constexpr StageText text{"frame-shell", "frame",
                                    "affine texture space of the tetrahedra of a shell",
                                    "Hirche, Ehlert, Guthe, Doggett 2004"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const ShellFaces<F> face(io);
        store_shell_frame(io, face.grad_u(), face.grad_v(), face.s_gradient(), params);
    }
};

}  // namespace quadrel
