// Samples at any place of their pixels, one per pixel, those of a quad at the same place: what the
// rasterizer has for standard samples, without its speed. Vertices stay where they were snapped.
#pragma once

#include <cstdint>
#include <vector>

#include "quadrel/raster/coverage.hpp"
#include "quadrel/raster/setup.hpp"
#include "quadrel/raster/tile_buffer.hpp"

namespace quadrel {

/// Places are counted in 1/8192 pixel: as fine as edge functions are exact in int64.
inline constexpr int place_units = 8192;

/// A place in a pixel, from its corner of smallest window x and y; each in [0, place_units).
struct SamplePlace {
    std::int32_t x = place_units / 2, y = place_units / 2;
    bool operator==(const SamplePlace&) const = default;
};

/// The places of the quads of a rectangle, of which some have a sample to be drawn.
class QuadPlaces {
  public:
    /// `rect`: window coordinates; x0 and y0 are even. No quad is drawn.
    void reset(const PixelRect& rect);

    /// The quad that holds the pixel.
    void draw(int x, int y, SamplePlace place) { quads_[index(x, y)] = {place, true}; }
    void leave_out(int x, int y) { quads_[index(x, y)].drawn = false; }
    bool is_drawn(int x, int y) const { return quads_[index(x, y)].drawn; }
    SamplePlace at(int x, int y) const { return quads_[index(x, y)].place; }

  private:
    struct Quad {
        SamplePlace place;
        bool drawn = false;
    };

    std::size_t index(int x, int y) const {
        return std::size_t((y - rect_.y0) / 2) * columns_ + std::size_t((x - rect_.x0) / 2);
    }

    PixelRect rect_;
    std::size_t columns_ = 0;
    std::vector<Quad> quads_;
};

/// As the functions of these names in coverage.hpp, for the quads that are drawn. The tile has one
/// sample per pixel, and its rectangle is that of the places.
void rasterize(const ScreenTriangle& triangle, std::uint32_t index, const QuadPlaces& places,
               TileBuffer& tile);
void collect_passing(const ScreenTriangle& triangle, std::uint32_t index, const QuadPlaces& places,
                     const TileBuffer& tile, std::vector<QuadCoverage>& quads,
                     DepthTest test = DepthTest::early);
void write_quad(const ScreenTriangle& triangle, const QuadCoverage& quad, const QuadPlaces& places,
                TileBuffer& tile);

/// attribute_edges of quad_points.hpp at the place of each of the quad's pixels, by a multiple of
/// 32 of the edge functions there.
void attribute_edges(const ScreenTriangle& triangle, const QuadCoverage& quad, SamplePlace place,
                     double* e0, double* e1, double* e2);

}  // namespace quadrel
