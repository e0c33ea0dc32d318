// Tiles and quads: nothing depends on how the frame is cut, and a quad is whole.
#include <algorithm>
#include <bit>
#include <map>

#include "quadrel/raster/samples.hpp"
#include "raster/block.hpp"
#include "raster/support.hpp"

namespace quadrel::test {
namespace {

constexpr int buffer_size = 50;

std::vector<ScreenTriangle> random_triangles(Random& random, int n, double reach) {
    RasterState state = y_down(buffer_size, buffer_size);
    std::vector<ScreenTriangle> triangles;
    while (int(triangles.size()) < n) {
        Corners corners;
        const double x = random.uniform(0, buffer_size), y = random.uniform(0, buffer_size);
        for (Corner& c : corners)
            c = {x + random.uniform(-reach, reach), y + random.uniform(-reach, reach),
                 random.uniform(0.5, 3), random.uniform(-0.2, 1.2)};
        ScreenTriangle t;
        if (set_up_triangle(to_clip(corners, state.viewport), state, t) == SetupOutcome::drawn)
            triangles.push_back(t);
    }
    return triangles;
}

/// Triangle and depth bits of each sample in the frame.
using SampleKey = std::array<int, 3>;
using Samples = std::map<SampleKey, std::pair<std::uint32_t, float>>;
using Quads = std::map<std::array<int, 3>, std::array<std::uint16_t, 4>>;

struct Drawn {
    Samples samples;
    Quads quads;
    bool repeated = false;
};

Drawn draw(const FrontEnd& front, const std::vector<ScreenTriangle>& triangles,
           const std::vector<PixelRect>& tiles, int samples) {
    Drawn drawn;
    for (const PixelRect& rect : tiles) {
        TileBuffer tile(rect, samples);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            front.draw(triangles[i], std::uint32_t(i), tile);
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                for (int s = 0; s < samples; ++s)
                    drawn.samples[{x, y, s}] = {tile.triangle(x, y, s), tile.depth(x, y, s)};
        std::vector<QuadCoverage> quads;
        front.collect(tile, quads);
        for (const QuadCoverage& q : quads)
            drawn.repeated |= !drawn.quads.insert({{q.y, q.x, int(q.triangle)}, q.samples}).second;
    }
    return drawn;
}

std::vector<PixelRect> tiling(const PixelRect& window, int width, int height) {
    std::vector<PixelRect> tiles;
    for (int y = window.y0; y < window.y1; y += height)
        for (int x = window.x0; x < window.x1; x += width)
            tiles.push_back(intersect(window, {x, y, x + width, y + height}));
    return tiles;
}

const PixelRect whole{0, 0, buffer_size, buffer_size};

/// Tiles of several sizes and a crop window show the same samples and the same quads.
testing::AssertionResult tiling_is_invisible(const FrontEnd& front, int samples) {
    Random random;
    const auto triangles = random_triangles(random, 40, 25);
    const Drawn reference = draw(front, triangles, {whole}, samples);
    for (auto [w, h] : {std::pair{2, 2}, {10, 6}, {16, 16}, {34, 50}}) {
        const Drawn other = draw(front, triangles, tiling(whole, w, h), samples);
        if (other.samples != reference.samples)
            return testing::AssertionFailure() << "samples, tiles of " << w << "x" << h;
        if (other.quads != reference.quads || other.repeated)
            return testing::AssertionFailure() << "quads, tiles of " << w << "x" << h;
    }
    const PixelRect crop{6, 14, 31, 37};
    const Drawn cropped = draw(front, triangles, tiling(crop, 10, 10), samples);
    for (const auto& [key, value] : cropped.samples)
        if (reference.samples.at(key) != value) return testing::AssertionFailure() << "crop";
    for (const auto& [key, value] : cropped.quads)
        if (!reference.quads.contains(key)) return testing::AssertionFailure() << "cropped quads";
    return testing::AssertionSuccess();
}

/// Quads are at even pixels, each (quad, triangle) once, and hold every visible sample once.
testing::AssertionResult quads_are_whole(const FrontEnd& front, int samples) {
    Random random;
    const PixelRect rect{2, 6, 45, 49};
    for (int trial = 0; trial < 20; ++trial) {
        const auto triangles = random_triangles(random, 1 + trial, 15);
        TileBuffer tile(rect, samples);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            front.draw(triangles[i], std::uint32_t(i), tile);
        std::vector<QuadCoverage> quads;
        front.collect(tile, quads);
        std::map<SampleKey, std::uint32_t> seen;
        std::array<std::uint32_t, 3> last{};
        for (const QuadCoverage& q : quads) {
            if (q.x % 2 || q.y % 2) return testing::AssertionFailure() << "odd quad";
            const std::array<std::uint32_t, 3> key{std::uint32_t(q.y), std::uint32_t(q.x),
                                                   q.triangle};
            if (&q != quads.data() && key <= last)
                return testing::AssertionFailure() << "order or repetition";
            last = key;
            for (int k = 0; k < 4; ++k)
                for (int s = 0; s < samples; ++s)
                    if (q.samples[k] >> s & 1) seen[{lane_x(q, k), lane_y(q, k), s}] = q.triangle;
        }
        std::size_t visible = 0;
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x)
                for (int s = 0; s < samples; ++s) {
                    const std::uint32_t expected = tile.triangle(x, y, s);
                    if (expected == no_triangle) continue;
                    ++visible;
                    if (!seen.contains({x, y, s}) || seen[{x, y, s}] != expected)
                        return testing::AssertionFailure() << "missing sample";
                }
        if (visible != seen.size()) return testing::AssertionFailure() << "sample of nothing";
    }
    return testing::AssertionSuccess();
}

using Masks = std::function<std::uint16_t(const ScreenTriangle&, int, int, int)>;

/// Samples on a regular grid (as the Vulkan CTS's reference renderer has them at four samples).
std::uint16_t regular_grid_mask(const ScreenTriangle& t, int x, int y, int samples) {
    std::uint16_t mask = 0;
    for (int s = 0; s < samples; ++s) {
        bool inside = true;
        for (const EdgeFunction& e : t.edge)
            inside &= e(x * 256 + 64 + s % 2 * 128, y * 256 + 64 + s / 2 * 128) >= e.threshold;
        mask |= std::uint16_t(inside << s);
    }
    return mask;
}

Masks masks_with(Planted planted) {
    if (planted == Planted::regular_sample_grid) return regular_grid_mask;
    return coverage_mask;
}

std::uint16_t mask_of(std::initializer_list<int> samples) {
    std::uint16_t mask = 0;
    for (int s : samples) mask |= std::uint16_t(1 << s);
    return mask;
}

testing::AssertionResult published_masks(const Masks& masks) {
    const RasterState state = y_down(4, 4);
    const ScreenTriangle corner = set_up({Corner{0, 0}, Corner{1, 0}, Corner{0, 1}}, state);
    const ScreenTriangle large = set_up({Corner{0, .5}, Corner{4, .5}, Corner{0, 4}}, state);
    if (masks(corner, 0, 0, 4) != mask_of({0, 2})) return testing::AssertionFailure() << "4x";
    if (masks(corner, 0, 0, 8) != mask_of({0, 3, 5})) return testing::AssertionFailure() << "8x";
    if (masks(corner, 0, 0, 16) != mask_of({1, 2, 4, 7, 9, 10, 11, 12, 15}))
        return testing::AssertionFailure() << "16x";
    if (masks(large, 0, 0, 4) != mask_of({2, 3})) return testing::AssertionFailure() << "large";
    return testing::AssertionSuccess();
}

using Centroids = std::function<QuadPoints(const ScreenTriangle&, int, int, int)>;

testing::AssertionResult centroids_follow_d3d(const Centroids& centroids) {
    const RasterState state = y_down(4, 4);
    const ScreenTriangle t = set_up({Corner{0, .5}, Corner{4, .5}, Corner{0, 4}}, state);
    const QuadPoints top = centroids(t, 0, 0, 4);
    // Lane 0 covers samples 2 and 3: sample 2. Lane 2, pixel (0, 1), is covered whole: its centre.
    if (top.x[0] != 32 || top.y[0] != 160) return testing::AssertionFailure() << "partial";
    if (top.x[2] != 128 || top.y[2] != 384) return testing::AssertionFailure() << "whole";
    const QuadPoints below = centroids(t, 2, 2, 4);  // pixel (3, 3) is not covered
    if (below.x[3] != 3 * 256 + 128 || below.y[3] != 3 * 256 + 128)
        return testing::AssertionFailure() << "helper";
    return testing::AssertionSuccess();
}

QuadPoints last_covered(const ScreenTriangle& t, int x, int y, int samples) {
    QuadPoints points = quad_centroids(t, x, y, samples);
    for (int k = 0; k < 4; ++k) {
        const int px = x + (k & 1), py = y + (k >> 1);
        const std::uint32_t mask = coverage_mask(t, px, py, samples);
        if (mask == 0 || mask == (1u << samples) - 1) continue;
        int s = samples - 1;
        while (!(mask >> s & 1)) --s;
        points.x[k] = px * 256 + sample_positions(samples)[s].x * 16;
        points.y[k] = py * 256 + sample_positions(samples)[s].y * 16;
    }
    return points;
}

Centroids centroids_with(Planted planted) {
    if (planted == Planted::last_covered_centroid) return last_covered;
    return quad_centroids;
}

bool is_within(const QuadCoverage& quad, const PixelRect& rect) {
    for (int k = 0; k < 4; ++k)
        if (quad.samples[k] && !rect.contains(lane_x(quad, k), lane_y(quad, k))) return false;
    return true;
}

/// In-order drawing with write_quad after each triangle gives what rasterize gives.
testing::AssertionResult in_order_equals_visibility(int samples, DepthCompare compare) {
    Random random;
    const PixelRect rect{4, 2, 47, 49};
    const auto triangles = random_triangles(random, 40, 20);
    TileBuffer visibility(rect, samples, compare), in_order(rect, samples, compare);
    std::vector<QuadCoverage> quads;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        rasterize(triangles[i], i, visibility);
        quads.clear();
        collect_passing(triangles[i], i, in_order, quads);
        for (const QuadCoverage& quad : quads) {
            if (!is_within(quad, rect)) return testing::AssertionFailure() << "outside the tile";
            write_quad(triangles[i], quad, in_order);
        }
    }
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            for (int s = 0; s < samples; ++s)
                if (visibility.triangle(x, y, s) != in_order.triangle(x, y, s) ||
                    visibility.depth(x, y, s) != in_order.depth(x, y, s))
                    return testing::AssertionFailure() << x << "," << y << "," << s;
    return testing::AssertionSuccess();
}

TEST(Tile, TilingIsInvisible) {
    for (int samples : {1, 4, 16}) EXPECT_TRUE(tiling_is_invisible(front_end(), samples));
    for (Planted planted :
         {Planted::quads_from_bounding_box, Planted::quads_from_tile, Planted::quad_once_per_pixel})
        EXPECT_FALSE(tiling_is_invisible(front_end(planted), 1)) << int(planted);
}

TEST(Tile, QuadsAreWhole) {
    for (int samples : {1, 2, 4, 8, 16}) EXPECT_TRUE(quads_are_whole(front_end(), samples));
    for (Planted planted :
         {Planted::quads_from_bounding_box, Planted::quads_from_tile, Planted::quad_once_per_pixel})
        EXPECT_FALSE(quads_are_whole(front_end(planted), 1)) << int(planted);
}

TEST(Tile, BlocksAgreeWithSingleSamples) {
    Random random;
    for (double reach : {1.0, 10.0, 100.0, 1e5})
        for (const ScreenTriangle& t : random_triangles(random, 100, reach)) {
            TileBuffer tile({0, 0, buffer_size, buffer_size}, 4);
            rasterize(t, 0, tile);
            for (int y = 0; y < buffer_size; ++y)
                for (int x = 0; x < buffer_size; ++x)
                    for (int s = 0; s < 4; ++s) {
                        const bool covered = coverage_mask(t, x, y, 4) >> s & 1;
                        const SamplePosition p = sample_positions(4)[s];
                        const float z = depth_at(t, x * 256 + p.x * 16, y * 256 + p.y * 16);
                        ASSERT_EQ(tile.triangle(x, y, s) == 0, covered && z < 1);
                        if (covered) {
                            ASSERT_EQ(tile.depth(x, y, s), z);
                        }
                    }
        }
}

TEST(Tile, BothArithmeticsGiveTheSameBits) {
    Random random;
    TileBuffer fast(whole, 8), exact(whole, 8);
    const auto triangles = random_triangles(random, 200, 60);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        EXPECT_TRUE(detail::fits_double(triangles[i], whole));
        detail::rasterize(triangles[i], i, fast, detail::EdgeArithmetic::automatic);
        detail::rasterize(triangles[i], i, exact, detail::EdgeArithmetic::int64);
    }
    for (int i = 0; i < buffer_size * buffer_size * 8; ++i) {
        const int x = i % buffer_size, y = i / buffer_size % buffer_size,
                  s = i / (buffer_size * buffer_size);
        ASSERT_EQ(fast.depth(x, y, s), exact.depth(x, y, s));
        ASSERT_EQ(fast.triangle(x, y, s), exact.triangle(x, y, s));
    }
    EXPECT_FALSE(detail::fits_double(random_triangles(random, 1, 5e5)[0], whole));
}

TEST(Tile, OrderOfTrianglesDoesNotMatter) {
    Random random;
    auto triangles = random_triangles(random, 30, 30);
    for (int i = 0; i < 10; ++i) triangles.push_back(triangles[i]);  // ties
    std::swap(triangles[1], triangles[39]);                          // of neighbours, too
    triangles[2] = triangles[1];
    TileBuffer forward(whole, 4), backward(whole, 4);
    for (std::uint32_t i = 0; i < 40; ++i) rasterize(triangles[i], i, forward);
    for (std::uint32_t i = 40; i-- > 0;) rasterize(triangles[i], i, backward);
    for (int i = 0; i < buffer_size * buffer_size; ++i)
        for (int s = 0; s < 4; ++s)
            ASSERT_EQ(forward.triangle(i % buffer_size, i / buffer_size, s),
                      backward.triangle(i % buffer_size, i / buffer_size, s));
}

TEST(Tile, InOrderEqualsVisibility) {
    for (int samples : {1, 2, 16})
        for (DepthCompare compare : {DepthCompare::less, DepthCompare::greater})
            EXPECT_TRUE(in_order_equals_visibility(samples, compare));
}

TEST(Tile, TheFarPlaneItselfIsNotNearer) {
    const Corners far{Corner{0, 0, 1, 1}, Corner{9, 0, 1, 1}, Corner{0, 9, 1, 1}};
    const ScreenTriangle t = set_up(far, y_down(buffer_size, buffer_size));
    TileBuffer tile(whole, 1);
    rasterize(t, 0, tile);
    EXPECT_EQ(tile.triangle(1, 1, 0), no_triangle);
    EXPECT_FALSE(tile.passes(1, 1, 0, 1.0f, 0));
}

TEST(Tile, CollectingWritesNothing) {
    Random random;
    TileBuffer tile(whole, 4);
    std::vector<QuadCoverage> once, twice;
    const ScreenTriangle t = random_triangles(random, 1, 30)[0];
    collect_passing(t, 3, tile, once);
    collect_passing(t, 3, tile, twice);
    EXPECT_FALSE(once.empty());
    EXPECT_EQ(once, twice);
}

TEST(Tile, ShadersDepthsAreTestedPerSample) {
    TileBuffer tile({0, 0, 4, 4}, 2);
    tile.write(0, 0, 0, 0.25f, 7);
    const QuadCoverage quad{0, 0, 9, {3, 1, 0, 0}};
    const auto written = write_quad_depth(quad, {0.5f, -1.0f, 0.1f, 0.1f}, tile);
    EXPECT_EQ(written, (std::array<std::uint16_t, 4>{2, 1, 0, 0}));
    EXPECT_EQ(tile.triangle(0, 0, 0), 7u);
    EXPECT_EQ(tile.triangle(0, 0, 1), 9u);
    EXPECT_EQ(tile.depth(1, 0, 0), 0.0f);
    EXPECT_EQ(tile.triangle(0, 1, 0), no_triangle);
}

TEST(Samples, StandardPositionsFillRowsAndColumns) {
    for (int n : {2, 4, 8, 16}) {
        std::uint32_t rows = 0, columns = 0;
        for (SamplePosition p : sample_positions(n)) {
            columns |= 1u << p.x;
            rows |= 1u << p.y;
        }
        EXPECT_EQ(std::popcount(rows), n);
        EXPECT_EQ(std::popcount(columns), n);
    }
    EXPECT_EQ(sample_positions(1)[0], (SamplePosition{8, 8}));
    EXPECT_EQ(sample_positions(4)[2], (SamplePosition{2, 10}));
    EXPECT_FALSE(is_sample_count(3));
}

TEST(Samples, PublishedMasks) {
    EXPECT_TRUE(published_masks(masks_with(Planted::none)));
    EXPECT_FALSE(published_masks(masks_with(Planted::regular_sample_grid)));
}

TEST(Samples, CentroidsFollowD3D) {
    EXPECT_TRUE(centroids_follow_d3d(centroids_with(Planted::none)));
    EXPECT_FALSE(centroids_follow_d3d(centroids_with(Planted::last_covered_centroid)));
    EXPECT_FALSE(centroids_follow_d3d(
        [](const ScreenTriangle&, int x, int y, int) { return quad_centres(x, y); }));
}

}  // namespace
}  // namespace quadrel::test
