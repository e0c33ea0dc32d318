// frame-prism: the texture space of a prism of the shell over a mesh, where a ray enters it.
// Objects of a material with this frame are drawn as shells, as by frame-shell, whose prisms are
// not cut into tetrahedra (prism_face.hpp): the search that goes with it is prism-gs. The eye has
// to be outside of the shell.
//
// Corrects frame-prism@published: J is the inverse of the prism's own map at the point,
//     P(a, b, c, s) = sum over the corners of weights (bottom s + top (1 - s)),
// whatever part of the texture the triangle has; the listing's axes are right for triangles that
// are half of the texture, along its axes. What is measured along the ray is as in frame-shell.
// Of depth 0 the mesh itself is drawn.
#pragma once

#include "quadrel/relief/shell/prism_face.hpp"
#include "quadrel/relief/shell/shell_frame.hpp"

namespace quadrel {

struct FramePrism : ShellFrame {
    static constexpr StageText text{"frame-prism", "frame",
                                    "texture space of the prisms of a shell, where rays enter",
                                    "correction of frame-prism@published"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const PrismGradients<F> gradient{PrismFaces<F>(io)};
        store_shell_frame(io, gradient.u, gradient.v, gradient.s, params);
    }
};

}  // namespace quadrel
