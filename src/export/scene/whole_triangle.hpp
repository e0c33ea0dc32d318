// A triangle of which nothing is clipped away.
#pragma once

#include <cstddef>

#include "quadrel/raster/assemble.hpp"

namespace quadrel {

/// Its vertices are the mesh's own: a GPU clips it, and weighs what they have.
inline AssembledTriangle whole_triangle() {
    AssembledTriangle whole;
    for (std::size_t v = 0; v < 3; ++v) whole.weights[v].perspective[v] = 1;
    return whole;
}

}  // namespace quadrel
