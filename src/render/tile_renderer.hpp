// Renders tiles: visibility, then shading batch by batch, material by material.
#pragma once

#include <memory>
#include <vector>

#include "quadrel/raster/tile_buffer.hpp"
#include "quadrel/render.hpp"
#include "render/batch.hpp"
#include "render/draw_record.hpp"
#include "render/geometry.hpp"
#include "render/render_plan.hpp"
#include "render/tile_film.hpp"

namespace quadrel {

/// A rectangle of the frame (window coordinates, whole quads) and the triangles that meet it.
struct Tile {
    PixelRect rect;
    std::vector<std::uint32_t> triangles;
};

/// Tiles of side `size` over `area`, on a grid that starts at the frame's origin.
std::vector<Tile> bin_triangles(const Geometry& geometry, const PixelRect& area, int size);

/// One thread's renderer.
class TileRenderer {
  public:
    TileRenderer(const Scene& scene, const RenderPlan& plan, const Geometry& geometry,
                 const FilmTarget& target, bool recording = false);

    void render(const Tile& tile);

    /// Visibility alone: the quads of the tile that are to be shaded.
    const std::vector<QuadCoverage>& find_visible(const Tile& tile);

    /// What was drawn so far and what it took; empty unless recording.
    DrawRecord record() const;

  private:
    void draw_opaque(const Tile& tile);
    void draw_discarding(const Tile& tile);
    void discard(std::vector<QuadCoverage>& quads);
    void shade();
    void count_quads();
    void run(const MaterialPlan& plan, std::uint32_t material, const QuadCoverage* quads,
             int count);
    std::uint32_t material_of(const QuadCoverage& quad) const;

    const Scene& scene_;
    const RenderPlan& plan_;
    const Geometry& geometry_;
    TileBuffer buffer_;
    TileFilm film_;
    Batch batch_;
    bool recording_;
    StageClock clock_;
    DrawRecord record_;
    std::vector<QuadCoverage> quads_;
};

}  // namespace quadrel
