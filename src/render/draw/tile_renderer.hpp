// Renders tiles: visibility, then shading batch by batch, material by material.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "quadrel/raster/tile_buffer.hpp"
#include "quadrel/render.hpp"
#include "render/draw/batch.hpp"
#include "render/draw/draw_record.hpp"
#include "render/draw/geometry.hpp"
#include "render/draw/tile_film.hpp"
#include "render/exact/exact_batch.hpp"
#include "render/integral/block_integral.hpp"
#include "render/plan/render_plan.hpp"
#include "render/stats/touched_texels.hpp"

namespace quadrel {

/// A rectangle of the frame (window coordinates, whole quads) and the triangles that meet it.
struct Tile {
    PixelRect rect;
    std::vector<std::uint32_t> triangles;
};

/// Tiles of side `size` over `area`, on a grid that starts at the frame's origin.
std::vector<Tile> bin_triangles(const Geometry& geometry, const PixelRect& area, int size);
/// The same of some triangles alone, given in their order.
std::vector<Tile> bin_triangles(const Geometry& geometry, std::span<const std::uint32_t> triangles,
                                const PixelRect& area, int size);

/// What a renderer writes down beside the film.
enum class Recording {
    nothing,
    times,   ///< of the stages, in one batch in seven; counts nothing
    counts,  ///< times, look-ups, lanes
    marks,   ///< texels that are touched, and steps that searches make; writes no film
};

/// One thread's renderer. Where it records marks, `touched` receives them, and plan_with_steps made
/// the plan.
class TileRenderer {
  public:
    TileRenderer(const Scene& scene, const RenderPlan& plan, const Geometry& geometry,
                 const FilmTarget& target, Recording recording = Recording::nothing,
                 const TouchedTexels* touched = nullptr);

    TileRenderer(const TileRenderer&) = delete;
    TileRenderer& operator=(const TileRenderer&) = delete;

    void render(const Tile& tile);

    /// Visibility alone: the quads of the tile that are to be shaded.
    const std::vector<QuadCoverage>& find_visible(const Tile& tile);

    /// What was drawn so far and what it took; the pixels alone unless recording.
    DrawRecord record() const;

  private:
    std::optional<std::uint32_t> find_solid(const Tile& tile) const;
    void draw_opaque(const Tile& tile);
    void draw_in_order(const Tile& tile);
    void draw_triangle(std::uint32_t t);
    void collect_covered(std::uint32_t t, DepthTest test);
    void write_kept(const ScreenTriangle& triangle, const QuadCoverage& quad);
    void draw_batch(const DrawnTriangle& triangle, std::span<QuadCoverage> quads);
    bool is_discarded(const Material& material, int i) const;
    void shade();
    Judges run_judges(std::uint32_t material, const QuadCoverage* quads, int count);
    void mark_presence(const Tile& tile);
    void mark_discarded();
    void add_undecided(int x, int y, std::uint32_t bits);
    void integrate(const Tile& tile);
    void integrate_block(const Tile& block);
    void write_integral();
    void count_quads();
    void run(const MaterialPlan& plan, std::uint32_t material, const QuadCoverage* quads,
             int count);
    void run_stages(const MaterialPlan& plan, std::uint32_t material,
                    std::span<const QuadCoverage> quads);
    [[noreturn]] void name_failing_quad(const MaterialPlan& plan, std::uint32_t material,
                                        std::span<const QuadCoverage> quads, std::string message);
    void mark(std::uint32_t material);
    void count_steps(const MaterialPlan& plan);
    void count_certified(std::uint32_t material, std::span<const QuadCoverage> quads);
    void count_certified_pixels(const RangeBatch& ranges, std::uint32_t material,
                                std::span<const QuadCoverage> quads);
    bool lacks_ray(std::uint32_t material, Uncertified reason) const;
    template <class Count>
    void for_each_seen(std::span<const QuadCoverage> quads, const Count& count) const;
    void count_kinds(const ErrorBatch& errors, std::span<const QuadCoverage> quads);
    std::uint32_t material_of(const QuadCoverage& quad) const;
    bool keeps_time() const {
        return recording_ == Recording::times || recording_ == Recording::counts;
    }

    const Scene& scene_;
    const RenderPlan& plan_;
    const Geometry& geometry_;
    TileBuffer buffer_;
    const FilmTarget& target_;
    TileFilm film_;
    ProbeCommand command_;
    Batch batch_;
    std::optional<ExactBatch> exact_;   ///< the same quads on dual numbers, where channels ask
    std::optional<ErrorBatch> errors_;  ///< the same quads with the judge's stages, likewise
    std::optional<RangeBatch> bounds_, limits_;  ///< and on ranges
    std::optional<BlockIntegral> integral_;      ///< where pixels are integrals
    const MaterialPlan* prepared_ = nullptr;     ///< the batch's arrays are this one's
    Recording recording_;
    const TouchedTexels* touched_;
    StageClock clock_;
    DrawRecord record_;
    std::vector<QuadCoverage> quads_;
    bool solid_ = false;                    ///< the quads are all those of the tile, and whole
    const ChannelSource* kind_ = nullptr;   ///< err.kind, where it is drawn
    bool certifies_pixels_ = false;         ///< certified.pixel is
    std::optional<std::size_t> undecided_;  ///< the plane of that channel, if it is
    std::vector<QuadCoverage> discarded_;   ///< lanes of the tile, for that
    bool solid_tiles_;                      ///< nothing asks for what only the buffer has
};

}  // namespace quadrel
