// The rasterizer's inner loops: one triangle over one sample plane of a tile, in 8x8 pixel blocks.
//
// A block that lies outside of one edge is skipped, one inside of all edges needs no test per
// pixel. Edge values are exact in either arithmetic: int64 always, double (which compilers
// vectorize) where no value in the tile reaches 2^52. So both give the same bits.
#pragma once

#include <algorithm>
#include <cstdint>

#include "quadrel/raster/samples.hpp"
#include "quadrel/raster/setup.hpp"
#include "quadrel/raster/tile_buffer.hpp"

namespace quadrel::detail {

inline constexpr int block_size = TileBuffer::block_size;

/// Coverage and depth of one sample of each pixel of a block, row by row.
struct BlockSamples {
    alignas(64) float depth[block_size * block_size];            ///< defined where covered
    alignas(64) std::uint32_t covered[block_size * block_size];  ///< 1 or 0
};

/// Edge functions of a sample plane relative to the tile's first pixel, with pixels as unit.
/// E is std::int64_t or double; all values are integers.
template <class E>
struct PlaneEdges {
    E origin[3], step_x[3], step_y[3], threshold[3];
    double depth0, depth1, depth2;
};

template <class E>
PlaneEdges<E> plane_edges(const ScreenTriangle& triangle, const PixelRect& tile,
                          SamplePosition sample) {
    PlaneEdges<E> plane;
    const std::int64_t x = std::int64_t(tile.x0) * subpixel_units + sample.x * 16;
    const std::int64_t y = std::int64_t(tile.y0) * subpixel_units + sample.y * 16;
    for (int i = 0; i < 3; ++i) {
        const EdgeFunction& edge = triangle.edge[i];
        plane.origin[i] = static_cast<E>(edge(x, y));
        plane.step_x[i] = static_cast<E>(edge.a * subpixel_units);
        plane.step_y[i] = static_cast<E>(edge.b * subpixel_units);
        plane.threshold[i] = static_cast<E>(edge.threshold);
    }
    plane.depth0 = triangle.vertex[0].depth;
    plane.depth1 = triangle.depth1;
    plane.depth2 = triangle.depth2;
    return plane;
}

/// True if every edge value at any sample of the tile's blocks is exact in double.
inline bool fits_double(const ScreenTriangle& triangle, const PixelRect& tile) {
    const double width = tile.width() + 2 * block_size, height = tile.height() + 2 * block_size;
    for (const EdgeFunction& edge : triangle.edge) {
        const double a = static_cast<double>(edge.a), b = static_cast<double>(edge.b);
        const double origin = static_cast<double>(
            edge(std::int64_t(tile.x0) * subpixel_units, std::int64_t(tile.y0) * subpixel_units));
        const double reach = (a < 0 ? -a : a) * width + (b < 0 ? -b : b) * height;
        if ((origin < 0 ? -origin : origin) + reach * subpixel_units >= 0x1p52) return false;
    }
    return true;
}

enum class BlockClass { outside, inside, partial };

/// `base` are the edge values at the block's first pixel.
template <class E>
BlockClass classify(const PlaneEdges<E>& plane, const E* base) {
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
        const E x = plane.step_x[i] * (block_size - 1), y = plane.step_y[i] * (block_size - 1);
        const E largest = base[i] + std::max(E(0), x) + std::max(E(0), y);
        const E smallest = base[i] + std::min(E(0), x) + std::min(E(0), y);
        if (largest < plane.threshold[i]) return BlockClass::outside;
        inside = inside && smallest >= plane.threshold[i];
    }
    return inside ? BlockClass::inside : BlockClass::partial;
}

/// The same expression as depth_at: z0 + (e1 k1 + e2 k2), clamped, rounded.
template <class E>
void block_depths(const PlaneEdges<E>& plane, const E* base, BlockSamples& block) {
    for (int y = 0; y < block_size; ++y) {
        const E row1 = base[1] + plane.step_y[1] * y, row2 = base[2] + plane.step_y[2] * y;
        for (int x = 0; x < block_size; ++x) {
            const double e1 = static_cast<double>(row1 + plane.step_x[1] * x);
            const double e2 = static_cast<double>(row2 + plane.step_x[2] * x);
            double depth = plane.depth0 + (e1 * plane.depth1 + e2 * plane.depth2);
            depth = depth < 0 ? 0 : depth;
            depth = depth > 1 ? 1 : depth;
            block.depth[y * block_size + x] = static_cast<float>(depth);
        }
    }
}

template <class E>
void block_coverage(const PlaneEdges<E>& plane, const E* base, BlockSamples& block) {
    for (int y = 0; y < block_size; ++y) {
        E row[3];
        for (int i = 0; i < 3; ++i) row[i] = base[i] + plane.step_y[i] * y - plane.threshold[i];
        for (int x = 0; x < block_size; ++x) {
            const bool inside = (row[0] + plane.step_x[0] * x >= 0) &
                                (row[1] + plane.step_x[1] * x >= 0) &
                                (row[2] + plane.step_x[2] * x >= 0);
            block.covered[y * block_size + x] = inside;
        }
    }
}

/// Calls visit(BlockSamples, x, y) for each block of the plane that may have covered samples; x, y
/// is the block's first pixel relative to the tile.
template <class E, class Visit>
void visit_plane(const PlaneEdges<E>& plane, const PixelRect& pixels, Visit visit) {
    BlockSamples block;
    for (int y = pixels.y0; y < pixels.y1; y += block_size) {
        for (int x = pixels.x0; x < pixels.x1; x += block_size) {
            E base[3];
            for (int i = 0; i < 3; ++i)
                base[i] = plane.origin[i] + plane.step_x[i] * x + plane.step_y[i] * y;
            const BlockClass kind = classify(plane, base);
            if (kind == BlockClass::outside) continue;
            if (kind == BlockClass::inside)
                std::fill(std::begin(block.covered), std::end(block.covered), 1u);
            else
                block_coverage(plane, base, block);
            block_depths(plane, base, block);
            visit(block, x, y);
        }
    }
}

/// The blocks of the tile that meet the triangle's bounds: relative to the tile, from a multiple of
/// the block size.
inline PixelRect touched_blocks(const ScreenTriangle& triangle, const PixelRect& tile) {
    const PixelRect both = intersect(triangle.bounds, tile);
    if (both.empty()) return {};
    const auto align = [](int n) { return n / block_size * block_size; };
    return {align(both.x0 - tile.x0), align(both.y0 - tile.y0), both.x1 - tile.x0,
            both.y1 - tile.y0};
}

enum class EdgeArithmetic { automatic, int64 };

/// visit(BlockSamples, x, y, sample) over all samples of the tile, plane by plane.
template <class Visit>
void visit_blocks(const ScreenTriangle& triangle, const PixelRect& tile, int samples, Visit visit,
                  EdgeArithmetic arithmetic = EdgeArithmetic::automatic) {
    const PixelRect pixels = touched_blocks(triangle, tile);
    if (pixels.empty()) return;
    const bool in_double = arithmetic == EdgeArithmetic::automatic && fits_double(triangle, tile);
    const auto positions = sample_positions(samples);
    for (int s = 0; s < samples; ++s) {
        const auto visit_sample = [&](const BlockSamples& block, int x, int y) {
            visit(block, x, y, s);
        };
        if (in_double)
            visit_plane(plane_edges<double>(triangle, tile, positions[s]), pixels, visit_sample);
        else
            visit_plane(plane_edges<std::int64_t>(triangle, tile, positions[s]), pixels,
                        visit_sample);
    }
}

/// quadrel::rasterize, the arithmetic chosen by the caller.
void rasterize(const ScreenTriangle& triangle, std::uint32_t index, TileBuffer& tile,
               EdgeArithmetic arithmetic);

}  // namespace quadrel::detail
