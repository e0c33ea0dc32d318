// The rays of a frame in the space of the relief: x and y are u and v, z is 0 on the polygon and
// falls with the depth.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "quadrel/scene/scene.hpp"

namespace quadrel::peers {

/// Rays in blocks of 4x4 pixels, row by row within, so that 8 or 16 neighbours are a packet. Each
/// starts on the polygon, moved into the first tile, and its direction falls by 1 a unit: t is the
/// depth.
struct Rays {
    std::array<std::vector<float>, 3> origin, direction;
    std::array<std::vector<float>, 2> tile;  ///< that the origin was moved from
    std::vector<std::size_t> pixel;          ///< index in rows from the top
    glm::vec3 light;                         ///< position, in the space that tiles are counted in
};

/// Of all pixels of a scene whose only object is a quad in its plane z = 0. The frame's sides are
/// multiples of 4.
Rays rays_of(const Scene& scene);

/// The part of the plane that rays cross within `depth`, from hit to light as well; it holds the
/// first tile.
struct Part {
    glm::dvec2 low{0}, high{1};
};
Part crossed(const Rays& rays, double depth);

}  // namespace quadrel::peers
