// prism-exact: the height field over a mesh by its shell, every tetrahedron met exactly.
//
// Sources: J. Hirche, A. Ehlert, S. Guthe, M. Doggett, "Hardware Accelerated Per-Pixel Displacement
// Mapping", Graphics Interface 2004: prisms in three tetrahedra, rays straight in the texture space
// of each. Differs: they step; this has where a ray leaves in closed form, and goes through the
// cells of level 0 as max-mip does, for rays that fall, rise or run level. What the tetrahedra have
// for a shell is no prism with bilinear sides (shell_face.hpp).
//
// Finds the first point of the ray in its tetrahedron at or below the surface up to rounding. A ray
// that enters below the surface has its hit there, flagged start-below: at the open border of a
// mesh, or from behind, a shell is a solid; between tetrahedra that is what rounding at a shared
// face would have let through. One that leaves without a hit is a miss, CLIP; nothing leaves
// through the bottom. `surface` says what lies between texel centres.
#pragma once

#include "quadrel/relief/shell/prism_search.hpp"

namespace quadrel {

struct PrismExact : PrismTrace {
    static constexpr StageText text{"prism-exact", "trace",
                                    "cells of a shell's tetrahedra on the way, exactly",
                                    "after Hirche et al. 2004; Tevs, Ihrke, Seidel 2008"};
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;

    struct Params {
        std::int32_t surface = 0;
    };
    static constexpr ValueName surface_names[] = {
        {0, "bilinear"}, {1, "tri-main"}, {2, "tri-anti"}};
    static constexpr std::array parameters{choice<&Params::surface>(
        "surface", "between texel centres: bilinear patches, or triangles along a diagonal",
        surface_names, 0)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        PrismSearch<Io> search(io, static_cast<PrismSurface>(params.surface));
        search_prism(search, *io.template texture<TextureSlot::max_mip>());
        search.store();
    }
};

}  // namespace quadrel
