// Where the fragments of one tile go: straight into the film's planes, or, where several fragments
// share a pixel's samples, first into per-sample planes that are resolved when the tile is done.
#pragma once

#include <limits>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/film/resolve.hpp"
#include "quadrel/raster/tile_buffer.hpp"
#include "render/draw/batch.hpp"
#include "render/errors/error_batch.hpp"
#include "render/exact/exact_batch.hpp"
#include "render/plan/channel_source.hpp"
#include "render/ranges/range_batch.hpp"

namespace quadrel {

/// The film that tiles write to: disjoint pixels, so no locks.
struct FilmTarget {
    Film* film;
    const std::vector<ChannelSource>* channels;  ///< parallel to the film's planes
    Viewport viewport;
    glm::vec4 background;
    /// Bits of each plane where nothing is drawn, for planes that hold what was there before; null
    /// where they hold these bits everywhere.
    const std::vector<std::uint32_t>* undrawn = nullptr;

    /// Index of a window pixel in the planes, or -1 outside of the film's window.
    std::ptrdiff_t index(int x, int y) const;
};

/// The shaded quads once more, where channels ask; else null.
struct Judges {
    const ExactBatch* exact = nullptr;                      ///< on dual numbers
    const ErrorBatch* errors = nullptr;                     ///< with the judge's stages
    const RangeBatch *bounds = nullptr, *limits = nullptr;  ///< on ranges
};

/// Collects what one tile shades.
class TileFilm {
  public:
    /// `rows`: whole quads side by side are written row by row, not lane by lane.
    TileFilm(const FilmTarget& target, int samples, bool rows)
        : target_(target),
          background_{target.background.r, target.background.g, target.background.b, 0,
                      std::numeric_limits<float>::infinity()},
          sample_count_(samples),
          rows_(rows) {}

    /// Starts a tile: every pixel of it becomes background. `covered`: each will be written.
    void begin(const PixelRect& rect, bool covered);

    /// Stores the shaded quads of a batch.
    void add(const Batch& batch, const QuadCoverage* quads, const Geometry& geometry,
             const TileBuffer& tile, const Judges& judges = {});

    /// Ends the tile: resolves the samples.
    void end();

    /// Pixels of the film that a fragment of any tile so far owns.
    std::uint64_t pixels() const { return pixels_; }

  private:
    /// A covered lane whose pixel the film holds.
    struct Fragment {
        std::ptrdiff_t pixel;    ///< index in the film's planes
        std::size_t tile_pixel;  ///< index in `states_`
        int lane;                ///< in the batch
        std::uint16_t samples;
        bool owns_pixel;  ///< holds the pixel's lowest covered sample
    };

    /// Quads side by side, all samples of whose pixels are covered and in the film.
    struct Run {
        int first, quads;          ///< in the batch
        std::ptrdiff_t even, odd;  ///< where their rows begin in the film's planes
    };

    /// What a pixel of the tile has got, under multisampling.
    enum class State : std::uint8_t {
        untouched,
        sampled,  ///< samples, to be resolved
        written,  ///< all that it gets: one fragment has all samples
    };

    void clear_tile() const;
    std::size_t tile_pixel(int x, int y) const;
    ColorSample* samples_of(std::size_t pixel);
    void put_resolved(std::ptrdiff_t pixel, const ColorSample& resolved) const;
    void collect(const QuadCoverage* quads, int count, const TileBuffer& tile);
    int run_length(const QuadCoverage* quads, int count) const;
    void collect_run(const QuadCoverage* quads, int first, int count);
    void collect_fragments(const QuadCoverage& quad, int q, const TileBuffer& tile);
    void add_samples(const Batch& batch);
    void add_values(const LaneBits& bits, std::uint32_t* plane) const;
    void add_constant(std::uint32_t bits, std::uint32_t* plane) const;
    template <class Bits>
    void add_fragments(const QuadCoverage* quads, std::uint32_t* plane, const Bits& bits) const;
    void add_plane(const ChannelSource& source, std::uint32_t* plane, const Batch& batch,
                   const QuadCoverage* quads, const Geometry& geometry, const TileBuffer& tile,
                   const Judges& judges) const;
    void add_range(const ChannelSource& source, std::uint32_t* plane, const QuadCoverage* quads,
                   const RangeBatch& ranges) const;
    std::uint32_t resolved_bits(const ChannelSource& source, const ColorSample& pixel) const;

    const FilmTarget& target_;
    ColorSample background_;
    int sample_count_;
    bool rows_;
    std::uint64_t pixels_ = 0;
    PixelRect rect_;
    PixelRect held_;  ///< what the film holds of it
    std::vector<Run> runs_;
    std::vector<Fragment> fragments_;
    std::vector<State> states_;         ///< [pixel], multisampling only
    std::size_t unwritten_ = 0;         ///< likewise: pixels in no run
    std::vector<ColorSample> samples_;  ///< [pixel][sample], likewise; of sampled pixels
};

}  // namespace quadrel
