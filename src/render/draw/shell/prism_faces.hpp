// The triangles of the surfaces of a shell's prisms (quadrel/relief/shell/prism_face.hpp).
#pragma once

#include <vector>

#include "quadrel/relief/shell/prism_face.hpp"
#include "render/draw/shell.hpp"

namespace quadrel {

/// A triangle of a prism's surface, counter-clockwise as seen from outside of it.
struct PrismTriangle {
    std::array<std::uint32_t, 3> index{};   ///< of the shell's vertices
    std::array<std::uint32_t, 3> corner{};  ///< of the mesh's triangle that each lies over
    std::array<float, 3> s{};
    std::array<std::uint32_t, 3> place{};  ///< of each: which of the prism's a, b, c it lies over
    PrismFace face{};                      ///< all but what clipping changes
};

/// Appends the surface of the prism over a triangle. Without depth: the triangle itself, with its
/// corners as they are drawn, in a prism of depth 1 that is as far off it as `seat` says.
void append_prism_faces(const Shell& shell, const Mesh& mesh, const Material& material,
                        const DrawnCorners& drawn, std::vector<PrismTriangle>& out);

/// The row of one piece of a triangle, in a window with as many bits behind the point.
PrimitiveVertices prism_row(const PrismTriangle& triangle, const AssembledTriangle& piece,
                            int subpixel_bits);

}  // namespace quadrel
