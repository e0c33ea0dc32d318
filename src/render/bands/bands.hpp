// An image as bands of tiles, from the top down: what is drawn of it at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/raster/viewport.hpp"
#include "render/draw/geometry.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel {

/// Whole rows of tiles.
struct Band {
    PixelRect area;                        ///< window coordinates, whole quads
    Window window;                         ///< its rows of the image's window
    std::vector<std::uint32_t> triangles;  ///< that meet it
};

/// The bands of a render, the top one first, of tiles of side `tile`.
std::vector<Band> make_bands(const PreparedRender& prepared, int tile);

}  // namespace quadrel
