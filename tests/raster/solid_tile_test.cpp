// Tiles that one triangle fills: told from its edges and depths, they hold what drawing gives.
#include "raster/solid_tile.hpp"

#include <bit>

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

constexpr int tile_size = 40;

/// What is told without drawing, real or with an error planted.
struct Teller {
    std::function<Cover(const ScreenTriangle&, const PixelRect&, int)> cover = cover_of;
    std::function<bool(const ScreenTriangle&, const PixelRect&, int, DepthCompare)> passes =
        passes_cleared;
    std::function<void(const PixelRect&, std::uint32_t, int, std::vector<QuadCoverage>&)> list =
        append_whole_quads;
};

/// Large triangles and slivers, half of them with a right angle; corners at half pixels put pixel
/// centres onto edges.
ScreenTriangle random_triangle(Random& random) {
    const RasterState state = y_down(tile_size, tile_size);
    const double reach = random.below(2) == 0 ? tile_size : 3 * tile_size;
    const double flatness = random.below(3) == 0 ? 0 : 1;
    const double middle = random.uniform(-0.1, 1.1);
    for (;;) {
        Corners corners;
        for (Corner& c : corners) {
            const auto place = [&] {
                return random.below(int(4 * reach)) / 2.0 - reach + tile_size / 2;
            };
            c = {place(), place(), 1, middle + flatness * random.uniform(-0.6, 0.6)};
        }
        if (random.below(2) == 0) {
            corners[1].x = corners[0].x;
            corners[2].y = corners[0].y;
        }
        ScreenTriangle triangle;
        if (set_up_triangle(to_clip(corners, state.viewport), state, triangle) ==
            SetupOutcome::drawn)
            return triangle;
    }
}

PixelRect random_rect(Random& random) {
    const int x = 2 * random.below(tile_size / 2), y = 2 * random.below(tile_size / 2);
    const int most_x = (tile_size - x) / 2, most_y = (tile_size - y) / 2;
    return {x, y, x + 2 + 2 * random.below(most_x), y + 2 + 2 * random.below(most_y)};
}

int covered(const ScreenTriangle& triangle, const PixelRect& rect, int samples) {
    int count = 0;
    for (int y = rect.y0; y < rect.y1; ++y)
        for (int x = rect.x0; x < rect.x1; ++x)
            count += std::popcount(coverage_mask(triangle, x, y, samples));
    return count;
}

/// Against samples one by one, and the quads against those of a buffer. Some tiles must be filled.
testing::AssertionResult tells_what_drawing_gives(const Teller& teller, DepthCompare compare,
                                                  int samples = 1) {
    Random random;
    int filled = 0, seen = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const ScreenTriangle triangle = random_triangle(random);
        const PixelRect rect = random_rect(random);
        const int there = rect.width() * rect.height() * samples;
        const int inside = covered(triangle, rect, samples);
        const Cover cover = teller.cover(triangle, rect, samples);
        if (cover == Cover::all ? inside != there : samples == 1 && inside == there)
            return testing::AssertionFailure() << inside << " of " << there << " are covered";
        if (cover == Cover::none && inside > 0)
            return testing::AssertionFailure() << inside << " samples are forgotten";
        if (cover != Cover::all) continue;
        ++filled;
        if (!teller.passes(triangle, rect, samples, compare)) continue;
        ++seen;
        TileBuffer tile(rect, samples, compare);
        rasterize(triangle, 7, tile);
        std::vector<QuadCoverage> expected, found;
        collect_quads(tile, expected);
        teller.list(rect, 7, samples, found);
        if (found != expected) return testing::AssertionFailure() << "other quads";
    }
    if (seen < 100 || seen == filled)
        return testing::AssertionFailure() << seen << " of " << filled << " pass";
    return testing::AssertionSuccess();
}

TEST(SolidTiles, HoldWhatDrawingGives) {
    for (const DepthCompare compare : {DepthCompare::less, DepthCompare::greater})
        for (const int samples : {1, 2, 4, 8, 16})
            EXPECT_TRUE(tells_what_drawing_gives({}, compare, samples)) << samples;
}

/// Cover by edge values at two corners, `threshold` being what is inside.
Cover cover_at(const ScreenTriangle& triangle, const std::vector<std::pair<int, int>>& pixels,
               bool fill_rule) {
    int inside = 0;
    for (const auto& [x, y] : pixels)
        inside += std::all_of(triangle.edge.begin(), triangle.edge.end(), [&](const auto& edge) {
            return edge(std::int64_t(x) * 256 + 128, std::int64_t(y) * 256 + 128) >=
                   (fill_rule ? edge.threshold : 0);
        });
    return inside == int(pixels.size()) ? Cover::all : Cover::some;
}

TEST(SolidTiles, ErrorsAreNoticed) {
    const auto corners = [](const PixelRect& r) {
        return std::vector<std::pair<int, int>>{
            {r.x0, r.y0}, {r.x1 - 1, r.y0}, {r.x0, r.y1 - 1}, {r.x1 - 1, r.y1 - 1}};
    };
    Teller two_corners, no_fill_rule, one_edge, no_depth, wrong_side, by_columns;
    two_corners.cover = [&](const auto& triangle, const PixelRect& r, int) {
        return cover_at(triangle, {{r.x0, r.y0}, {r.x1 - 1, r.y1 - 1}}, true);
    };
    no_fill_rule.cover = [&](const auto& triangle, const PixelRect& r, int) {
        return cover_at(triangle, corners(r), false);
    };
    one_edge.cover = [&](ScreenTriangle triangle, const PixelRect& r, int samples) {
        triangle.edge[1] = triangle.edge[2] = triangle.edge[0];
        return cover_of(triangle, r, samples);
    };
    no_depth.passes = [](const auto&, const auto&, int, DepthCompare) { return true; };
    wrong_side.passes = [](const auto& triangle, const auto& rect, int samples,
                           DepthCompare compare) {
        return passes_cleared(
            triangle, rect, samples,
            compare == DepthCompare::less ? DepthCompare::greater : DepthCompare::less);
    };
    by_columns.list = [](const PixelRect& r, std::uint32_t triangle, int, auto& quads) {
        for (int x = r.x0; x < r.x1; x += 2)
            for (int y = r.y0; y < r.y1; y += 2) quads.push_back({x, y, triangle, {1, 1, 1, 1}});
    };
    const Teller all[] = {two_corners, no_fill_rule, one_edge, no_depth, wrong_side, by_columns};
    for (const Teller& planted : all)
        EXPECT_FALSE(tells_what_drawing_gives(planted, DepthCompare::less))
            << "error " << &planted - all;
    Teller centres;
    centres.cover = [](const auto& triangle, const PixelRect& r, int) {
        return cover_of(triangle, r, 1);
    };
    EXPECT_FALSE(tells_what_drawing_gives(centres, DepthCompare::less, 4));
}

/// No depths, or such that their roundings are no longer small: never told, whatever they are.
TEST(SolidTiles, DepthsOutOfBoundsAreDrawn) {
    Random random;
    ScreenTriangle triangle = random_triangle(random);
    const PixelRect rect{0, 0, 2, 2};
    for (const double depth : {std::numeric_limits<double>::quiet_NaN(), 0x1p30, -0x1p30}) {
        for (ScreenVertex& vertex : triangle.vertex) vertex.depth = depth;
        triangle.depth1 = triangle.depth2 = 0;
        EXPECT_FALSE(passes_cleared(triangle, rect, 1, DepthCompare::less)) << depth;
        EXPECT_FALSE(passes_cleared(triangle, rect, 1, DepthCompare::greater)) << depth;
    }
}

}  // namespace
}  // namespace quadrel::test
