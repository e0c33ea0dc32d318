#include "quadrel/raster/coverage.hpp"

#include <algorithm>

#include "quadrel/check.hpp"
#include "quadrel/raster/samples.hpp"
#include "raster/block.hpp"

namespace quadrel {
namespace {

using detail::block_size;
using detail::BlockSamples;

std::int64_t sample_x(int x, SamplePosition sample) {
    return std::int64_t(x) * subpixel_units + sample.x * 16;
}

/// The depth test of TileBuffer::passes on one row of a block, without branches.
template <DepthCompare compare>
bool wins(float depth, std::uint32_t index, float old_depth, std::uint32_t old_index) {
    const bool nearer = compare == DepthCompare::less ? depth < old_depth : depth > old_depth;
    return nearer | ((depth == old_depth) & (index < old_index) & (old_index != no_triangle));
}

template <DepthCompare compare>
void resolve_block(const BlockSamples& block, std::uint32_t index, float* depth,
                   std::uint32_t* triangle, int stride) {
    for (int y = 0; y < block_size; ++y, depth += stride, triangle += stride) {
        const float* z = block.depth + y * block_size;
        const std::uint32_t* covered = block.covered + y * block_size;
        for (int x = 0; x < block_size; ++x) {
            const bool pass = (covered[x] != 0) & wins<compare>(z[x], index, depth[x], triangle[x]);
            depth[x] = pass ? z[x] : depth[x];
            triangle[x] = pass ? index : triangle[x];
        }
    }
}

template <DepthCompare compare>
void rasterize_with(const ScreenTriangle& triangle, std::uint32_t index, TileBuffer& tile,
                    detail::EdgeArithmetic arithmetic) {
    const PixelRect& rect = tile.rect();
    detail::visit_blocks(
        triangle, rect, tile.samples(),
        [&](const BlockSamples& block, int x, int y, int sample) {
            const std::size_t at = tile.index(rect.x0 + x, rect.y0 + y, sample);
            resolve_block<compare>(block, index, tile.depths() + at, tile.triangles() + at,
                                   tile.stride());
        },
        arithmetic);
}

/// The triangle indices of a quad's samples, lane by lane; lanes outside of the tile have none.
struct QuadIndices {
    std::array<std::array<std::uint32_t, 16>, 4> lane;
    int samples;

    QuadIndices(const TileBuffer& tile, int x, int y) : samples(tile.samples()) {
        for (int k = 0; k < 4; ++k) {
            const int px = x + (k & 1), py = y + (k >> 1);
            const bool inside = tile.rect().contains(px, py);
            for (int s = 0; s < samples; ++s)
                lane[k][s] = inside ? tile.triangle(px, py, s) : no_triangle;
        }
    }

    /// The smallest index that is >= low; no_triangle if there is none.
    std::uint32_t smallest_from(std::uint32_t low) const {
        std::uint32_t smallest = no_triangle;
        for (int k = 0; k < 4; ++k)
            for (int s = 0; s < samples; ++s)
                if (lane[k][s] >= low) smallest = std::min(smallest, lane[k][s]);
        return smallest;
    }

    QuadCoverage coverage(int x, int y, std::uint32_t triangle) const {
        QuadCoverage quad{x, y, triangle, {}};
        for (int k = 0; k < 4; ++k)
            for (int s = 0; s < samples; ++s)
                quad.samples[k] |= std::uint16_t((lane[k][s] == triangle) << s);
        return quad;
    }
};

void collect_quad(const TileBuffer& tile, int x, int y, std::vector<QuadCoverage>& quads) {
    const QuadIndices indices(tile, x, y);
    std::uint32_t triangle = indices.smallest_from(0);
    while (triangle != no_triangle) {
        quads.push_back(indices.coverage(x, y, triangle));
        triangle = indices.smallest_from(triangle + 1);
    }
}

/// A quad wholly inside of the tile, which mostly shows one triangle or none.
void collect_inner_quad(const TileBuffer& tile, int x, int y, std::vector<QuadCoverage>& quads) {
    const std::uint32_t first = tile.triangle(x, y, 0);
    std::uint32_t difference = 0;
    for (int s = 0; s < tile.samples(); ++s) {
        const std::uint32_t* row = tile.triangles() + tile.index(x, y, s);
        const std::uint32_t* next = row + tile.stride();
        difference |= (row[0] ^ first) | (row[1] ^ first) | (next[0] ^ first) | (next[1] ^ first);
    }
    if (difference != 0) return collect_quad(tile, x, y, quads);
    const auto all = static_cast<std::uint16_t>((1u << tile.samples()) - 1);
    if (first != no_triangle) quads.push_back({x, y, first, {all, all, all, all}});
}

/// Bit (8 y + x) set where the sample of the block is covered, passes, and lies in the tile.
using PassMasks = std::array<std::uint64_t, 16>;

std::uint64_t passing_mask(const BlockSamples& block, const TileBuffer& tile, int x0, int y0,
                           int sample, std::uint32_t index, DepthTest test) {
    std::uint64_t mask = 0;
    for (int i = 0; i < block_size * block_size; ++i) {
        const int x = x0 + i % block_size, y = y0 + i / block_size;
        if (block.covered[i] && tile.rect().contains(x, y) &&
            (test == DepthTest::late || tile.passes(x, y, sample, block.depth[i], index)))
            mask |= std::uint64_t(1) << i;
    }
    return mask;
}

void append_quads(const PassMasks& masks, int samples, int x0, int y0, std::uint32_t index,
                  std::vector<QuadCoverage>& quads) {
    for (int y = 0; y < block_size; y += 2)
        for (int x = 0; x < block_size; x += 2) {
            QuadCoverage quad{x0 + x, y0 + y, index, {}};
            for (int s = 0; s < samples; ++s)
                for (int k = 0; k < 4; ++k) {
                    const int bit = (y + (k >> 1)) * block_size + x + (k & 1);
                    quad.samples[k] |= std::uint16_t(((masks[s] >> bit) & 1) << s);
                }
            if (quad.is_any()) quads.push_back(quad);
        }
}

/// Calls write(x, y, lane, sample) for each sample that is set.
template <class Write>
void for_each_sample(const QuadCoverage& quad, Write write) {
    for (int lane = 0; lane < 4; ++lane)
        for (int s = 0; s < 16; ++s)
            if ((quad.samples[lane] >> s) & 1)
                write(lane_x(quad, lane), lane_y(quad, lane), lane, s);
}

}  // namespace

namespace detail {

void rasterize(const ScreenTriangle& triangle, std::uint32_t index, TileBuffer& tile,
               EdgeArithmetic arithmetic) {
    QUADREL_CHECK(index != no_triangle, index);
    if (tile.compare() == DepthCompare::less)
        rasterize_with<DepthCompare::less>(triangle, index, tile, arithmetic);
    else
        rasterize_with<DepthCompare::greater>(triangle, index, tile, arithmetic);
}

}  // namespace detail

bool may_cover(const ScreenTriangle& triangle, int samples) {
    const PixelRect& bounds = triangle.bounds;
    // A box of three pixels holds a sample whatever the pattern.
    if (bounds.width() > 3 && bounds.height() > 3) return true;
    const auto& v = triangle.vertex;
    const auto [x0, x1] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [y0, y1] = std::minmax({v[0].y, v[1].y, v[2].y});
    // Whether low to high holds a number that is `rest` more than a multiple of a pixel.
    const auto holds = [](std::int32_t low, std::int32_t high, std::int32_t rest) {
        return (high - rest) >> 8 > (low - 1 - rest) >> 8;
    };
    return std::ranges::any_of(sample_positions(samples), [&](const SamplePosition& sample) {
        return holds(x0, x1, sample.x * 16) && holds(y0, y1, sample.y * 16);
    });
}

std::uint16_t coverage_mask(const ScreenTriangle& triangle, int x, int y, int samples) {
    if (!triangle.bounds.contains(x, y)) return 0;
    std::uint16_t mask = 0;
    const auto positions = sample_positions(samples);
    for (int s = 0; s < samples; ++s) {
        bool inside = true;
        for (const EdgeFunction& edge : triangle.edge)
            inside = inside &&
                     edge(sample_x(x, positions[s]),
                          std::int64_t(y) * subpixel_units + positions[s].y * 16) >= edge.threshold;
        mask |= std::uint16_t(inside << s);
    }
    return mask;
}

void rasterize(const ScreenTriangle& triangle, std::uint32_t index, TileBuffer& tile) {
    detail::rasterize(triangle, index, tile, detail::EdgeArithmetic::automatic);
}

void collect_quads(const TileBuffer& tile, std::vector<QuadCoverage>& quads) {
    const PixelRect& rect = tile.rect();
    for (int y = rect.y0; y < rect.y1; y += 2)
        for (int x = rect.x0; x < rect.x1; x += 2) {
            if (x + 1 < rect.x1 && y + 1 < rect.y1)
                collect_inner_quad(tile, x, y, quads);
            else
                collect_quad(tile, x, y, quads);
        }
}

void collect_passing(const ScreenTriangle& triangle, std::uint32_t index, const TileBuffer& tile,
                     std::vector<QuadCoverage>& quads, DepthTest test) {
    QUADREL_CHECK(index != no_triangle, index);
    const PixelRect& rect = tile.rect();
    const PixelRect pixels = detail::touched_blocks(triangle, rect);
    for (int y = pixels.y0; y < pixels.y1; y += block_size)
        for (int x = pixels.x0; x < pixels.x1; x += block_size) {
            const int x0 = rect.x0 + x, y0 = rect.y0 + y;
            const PixelRect block_rect{x0, y0, x0 + block_size, y0 + block_size};
            PassMasks masks{};
            detail::visit_blocks(triangle, block_rect, tile.samples(),
                                 [&](const BlockSamples& block, int, int, int sample) {
                                     masks[sample] =
                                         passing_mask(block, tile, x0, y0, sample, index, test);
                                 });
            append_quads(masks, tile.samples(), x0, y0, index, quads);
        }
}

void write_quad(const ScreenTriangle& triangle, const QuadCoverage& quad, TileBuffer& tile) {
    const auto positions = sample_positions(tile.samples());
    for_each_sample(quad, [&](int x, int y, int, int s) {
        const float depth = depth_at(triangle, sample_x(x, positions[s]),
                                     std::int64_t(y) * subpixel_units + positions[s].y * 16);
        if (tile.passes(x, y, s, depth, quad.triangle)) tile.write(x, y, s, depth, quad.triangle);
    });
}

std::array<std::uint16_t, 4> write_quad_depth(const QuadCoverage& quad,
                                              const std::array<float, 4>& depth, TileBuffer& tile) {
    std::array<std::uint16_t, 4> written{};
    for_each_sample(quad, [&](int x, int y, int lane, int s) {
        const float z = depth[lane] >= 0 ? std::min(depth[lane], 1.0f) : 0.0f;
        if (!tile.passes(x, y, s, z, quad.triangle)) return;
        tile.write(x, y, s, z, quad.triangle);
        written[lane] |= std::uint16_t(1 << s);
    });
    return written;
}

}  // namespace quadrel
