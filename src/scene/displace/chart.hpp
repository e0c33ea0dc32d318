// A triangle of the mesh in texture space.
#pragma once

#include <utility>

#include "scene/displace/base.hpp"
#include "scene/displace/cell_polygon.hpp"

namespace quadrel::displacement {

/// A triangle of the mesh as it lies in texture space.
struct Chart {
    std::array<std::size_t, 3> corner{0, 1, 2};  ///< of the mesh's triangle
    Corners place;  ///< in that order, counter-clockwise if it has an area
    bool mirrored = false, degenerate = false;

    Chart(const Base& base, std::size_t t) {
        const auto& index = base.mesh.triangles[t];
        const auto at = [&](std::size_t k) { return base.places[index[k]]; };
        const Int128 area = side_of(at(0), at(1), at(2));
        mirrored = area < 0;
        degenerate = area == 0;
        if (mirrored) std::swap(corner[1], corner[2]);
        for (std::size_t k = 0; k < 3; ++k) place[k] = at(corner[k]);
    }

    /// Side k of the chart, from its corner k, as the triangle's edges know it.
    Side side(const Edges& edges, std::size_t t, std::size_t k) const {
        if (!mirrored) return edges.side(t, k);
        Side side = edges.side(t, corner[(k + 1) % 3]);
        side.reversed = !side.reversed;
        return side;
    }
};

}  // namespace quadrel::displacement
