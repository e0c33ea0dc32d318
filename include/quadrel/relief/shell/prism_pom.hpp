// prism-pom: parallax occlusion mapping through a shell: even steps from where a ray enters a
// tetrahedron to where it leaves, then the chord of the last two heights.
//
// Source: C. Dachsbacher, N. Tatarchuk, "Prism Parallax Occlusion Mapping with Accurate Silhouette
// Generation", I3D 2007, of which neither a listing nor the whole text could be found: there is no
// row of it as published. As others describe it: entry and exit on the faces of a prism, and a
// march between both with the direction in texture space taken as constant. Corrects it as J.
// Hirche et al., "Hardware Accelerated Per-Pixel Displacement Mapping", 2004, do: in a tetrahedron
// the direction is constant (shell_face.hpp). Steps are as long in all of them, 1 / steps of the
// shell's depth in the world and at most `most`; a tetrahedron has one at least. Where a ray enters
// is tested, too, and so is where it leaves. Misses what is thinner than a step. Exact where
// heights are linear between two samples; a ray that meets nothing is a miss, CLIP, but at the
// shell's bottom.
#pragma once

#include "quadrel/relief/shell/prism_march.hpp"

namespace quadrel {

struct PrismPom : PrismMarchTrace {
    static constexpr StageText text{"prism-pom", "trace",
                                    "even steps through a shell's tetrahedra and one chord",
                                    "after Dachsbacher and Tatarchuk 2007; Hirche et al. 2004"};
    struct Params {
        std::int32_t steps = 16, most = 64;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the shell's depth", 1, most_steps, 16),
        parameter<&Params::most>("most", "1", "most steps in a tetrahedron", 1, most_steps, 64)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        PrismMarch<Io> search(io, prism_ray(io));
        search.march(params.steps, params.most);
        search.store();
    }
};

}  // namespace quadrel
