// Where the fragments of one tile go: straight into the film's planes, or, under multisampling,
// first into per-sample planes that are resolved when the tile is done.
#pragma once

#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/film/resolve.hpp"
#include "quadrel/raster/tile_buffer.hpp"
#include "render/draw/batch.hpp"
#include "render/plan/channel_source.hpp"

namespace quadrel {

/// The film that tiles write to: disjoint pixels, so no locks.
struct FilmTarget {
    Film* film;
    const std::vector<ChannelSource>* channels;  ///< parallel to the film's planes
    Viewport viewport;
    glm::vec4 background;

    /// Index of a window pixel in the planes, or -1 outside of the film's window.
    std::ptrdiff_t index(int x, int y) const;
};

/// Collects what one tile shades.
class TileFilm {
  public:
    TileFilm(const FilmTarget& target, int samples) : target_(target), sample_count_(samples) {}

    /// Starts a tile: every pixel of it becomes background.
    void begin(const PixelRect& rect);

    /// Stores the shaded quads of a batch.
    void add(const Batch& batch, const QuadCoverage* quads, const Geometry& geometry,
             const TileBuffer& tile);

    /// Ends the tile: resolves the samples.
    void end();

    /// Pixels of the film that a fragment of any tile so far owns.
    std::uint64_t pixels() const { return pixels_; }

  private:
    /// A covered lane whose pixel the film holds.
    struct Fragment {
        std::ptrdiff_t pixel;    ///< index in the film's planes
        std::size_t tile_pixel;  ///< index in `samples_`, in pixels
        int lane;                ///< in the batch
        int lowest_sample;       ///< that the fragment owns
        std::uint16_t samples;
        bool owns_pixel;  ///< holds the pixel's lowest covered sample
        const QuadCoverage* quad;
    };

    void collect_fragments(const Batch& batch, const QuadCoverage* quads, const TileBuffer& tile);
    void add_samples(const Batch& batch);
    void add_plane(const ChannelSource& source, std::vector<std::uint32_t>& plane,
                   const Batch& batch, const Geometry& geometry, const TileBuffer& tile) const;
    std::uint32_t fragment_bits(const ChannelSource& source, const Batch& batch,
                                const Fragment& fragment, const Geometry& geometry,
                                const TileBuffer& tile) const;
    std::uint32_t resolved_bits(const ChannelSource& source, const ColorSample& pixel) const;

    const FilmTarget& target_;
    int sample_count_;
    std::uint64_t pixels_ = 0;
    PixelRect rect_;
    std::vector<Fragment> fragments_;
    std::vector<ColorSample> samples_;  ///< [pixel][sample], multisampling only
};

}  // namespace quadrel
