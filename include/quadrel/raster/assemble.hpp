// A primitive of the mesh to screen triangles: clip, divide, snap, cull.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "quadrel/raster/setup.hpp"

namespace quadrel {

/// Coefficients of the primitive's three vertices at one vertex of a piece of it (see `weigh`).
struct VertexWeights {
    std::array<double, 3> perspective{};  ///< for perspective-correct varyings
    std::array<double, 3> window{};       ///< for noperspective varyings
};

/// A piece of a primitive: the whole of it, or one triangle of the clipped polygon.
struct AssembledTriangle {
    ScreenTriangle screen;
    std::array<VertexWeights, 3> weights;
    bool clipped =
        false;  ///< false: the vertices are the primitive's own, weights are unit vectors
};

/// What became of primitives, and of the triangles they were cut into.
struct PrimitiveCounts {
    // primitives
    std::uint64_t submitted = 0;
    std::uint64_t non_finite = 0;  ///< discarded for NaN or infinite positions
    std::uint64_t outside = 0;     ///< wholly clipped away
    std::uint64_t clipped = 0;     ///< cut into a polygon
    // triangles
    std::uint64_t zero_area = 0, culled = 0, off_frame = 0, drawn = 0;

    PrimitiveCounts& operator+=(const PrimitiveCounts& other);
    bool operator==(const PrimitiveCounts&) const = default;
};

/// Appends the drawn pieces of a triangle to `out`, in polygon order, and counts what happened.
void assemble_triangle(const std::array<glm::vec4, 3>& clip, const RasterState& state,
                       std::vector<AssembledTriangle>& out, PrimitiveCounts& counts);

}  // namespace quadrel
