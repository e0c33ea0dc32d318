// Shorter ways of drawing that give the same bits as the plain ones. A render without skipping
// takes none of them, and tests take them one by one.
#pragma once

namespace quadrel {

struct Shortcuts {
    bool film_rows = true;    ///< runs of whole quads go into the film row by row
    bool edge_runs = true;    ///< edge functions are stepped along runs of quads
    bool solid_tiles = true;  ///< a tile inside of one triangle needs no depth test
    bool chains = true;       ///< kernels of several stages, where a plan has their stages
    bool shared_scales =
        true;  ///< textures of one size have one scale factor of the undisplaced UV
};

inline constexpr Shortcuts no_shortcuts{false, false, false, false, false};

}  // namespace quadrel
