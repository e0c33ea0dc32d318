// Coverage at one sample: fill rule, watertightness, facing.
#include <cmath>

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

std::vector<Corners> fan(const std::vector<Corner>& ring, Corner centre) {
    std::vector<Corners> triangles;
    for (std::size_t i = 0; i < ring.size(); ++i)
        triangles.push_back({ring[i], ring[(i + 1) % ring.size()], centre});
    return triangles;
}

std::vector<Snapped> snapped_ring(const std::vector<Corner>& ring, const Viewport& viewport) {
    std::vector<Snapped> result;
    for (const Corner& c : ring) {
        const WindowPoint p = to_window(viewport, to_clip(c, viewport));
        result.push_back({snap(p.x), snap(p.y)});
    }
    return result;
}

/// Each pixel whose (moved) centre the ring winds around once is covered by one triangle, all
/// others by none.
testing::AssertionResult covers_ring_once(const CoverageMap& map,
                                          const std::vector<Snapped>& ring) {
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const int expected = std::abs(winding_number(ring, x * 256 + 128, y * 256 + 128));
            if (map.at(x, y) != expected)
                return testing::AssertionFailure() << "pixel " << x << "," << y << " covered "
                                                   << map.at(x, y) << " times, not " << expected;
        }
    return testing::AssertionSuccess();
}

/// The point of the square [-1, 1]^2's border at t in [0, 4), counted around it.
Corner square_border(double t) {
    const double along = 2 * (t - std::floor(t)) - 1;
    switch (int(t)) {
        case 0:
            return {along, -1};
        case 1:
            return {1, along};
        case 2:
            return {-along, 1};
        default:
            return {-1, -along};
    }
}

/// A ring that sees its centre everywhere; sometimes tiny.
std::vector<Corner> random_ring(Random& random, Corner centre, bool on_grid) {
    const int n = 4 + random.below(8);
    const double size = on_grid || random.below(2) ? 1 : 0.2;
    std::vector<Corner> ring;
    for (int i = 0; i < n; ++i) {
        const Corner towards = square_border(4 * (i + random.uniform(0.1, 0.4)) / n);
        const double radius = size * random.uniform(4, 7);
        Corner c{centre.x + radius * towards.x, centre.y + radius * towards.y};
        if (on_grid) c = {std::round(c.x * 2) / 2, std::round(c.y * 2) / 2};
        ring.push_back(c);
    }
    return ring;
}

/// Random fans; every second one on the half-pixel grid, where samples lie on edges and vertices.
testing::AssertionResult fans_are_watertight(const FrontEnd& front, int fans) {
    const RasterState state = y_down(16, 16);
    Random random;
    for (int i = 0; i < fans; ++i) {
        const bool on_grid = i % 2 == 0;
        Corner centre{random.uniform(7, 9), random.uniform(7, 9)};
        if (on_grid) centre = {7.5 + random.below(4) * 0.5, 7.5 + random.below(4) * 0.5};
        const auto ring = random_ring(random, centre, on_grid);
        const auto result = covers_ring_once(coverage(front, fan(ring, centre), state),
                                             snapped_ring(ring, state.viewport));
        if (!result) return testing::AssertionFailure() << "fan " << i << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

/// A jittered grid of n x n cells over (most of) the frame, either diagonal.
std::vector<Corners> random_mesh(Random& random, int n, double cell, bool on_grid) {
    std::vector<Corner> v;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const bool rim = x == 0 || y == 0 || x == n || y == n;
            const double jitter = rim ? 0 : 0.3 * cell;
            Corner c{1.25 + x * cell + random.uniform(-jitter, jitter),
                     1.5 + y * cell + random.uniform(-jitter, jitter)};
            if (on_grid) c = {std::round(c.x * 4) / 4, std::round(c.y * 4) / 4};
            v.push_back(c);
        }
    std::vector<Corners> triangles;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const Corner a = v[y * (n + 1) + x], b = v[y * (n + 1) + x + 1];
            const Corner c = v[(y + 1) * (n + 1) + x], d = v[(y + 1) * (n + 1) + x + 1];
            const bool diagonal = random.below(2) == 0;
            triangles.push_back(diagonal ? Corners{a, b, d} : Corners{a, b, c});
            triangles.push_back(diagonal ? Corners{a, d, c} : Corners{b, d, c});
        }
    return triangles;
}

testing::AssertionResult meshes_are_watertight(const FrontEnd& front, int meshes) {
    const RasterState state = y_down(32, 32);
    const double n = 8, cell = 3.5;
    const std::vector<Corner> rim{{1.25, 1.5},
                                  {1.25 + n * cell, 1.5},
                                  {1.25 + n * cell, 1.5 + n * cell},
                                  {1.25, 1.5 + n * cell}};
    Random random;
    for (int i = 0; i < meshes; ++i) {
        const auto triangles = random_mesh(random, int(n), cell, i % 2 == 0);
        const auto result =
            covers_ring_once(coverage(front, triangles, state), snapped_ring(rim, state.viewport));
        if (!result) return result;
    }
    return testing::AssertionSuccess();
}

/// Horizontal and vertical edges through pixel centres.
void make_right_angled(std::vector<Corner>& ring) {
    for (Corner& c : ring) c = {std::floor(c.x) + 0.5, std::floor(c.y) + 0.5};
    ring[1].x = ring[0].x;
    ring[2].y = ring[0].y;
}

/// Triangles of any size and both windings against the moved-sample oracle; many on a quarter-pixel
/// grid, some reaching thousands of pixels beyond the frame.
testing::AssertionResult agrees_with_moved_samples(const FrontEnd& front, Conventions conventions,
                                                   int triangles) {
    RasterState state = y_down(32, 32);
    state.viewport.conventions = conventions;
    Random random;
    for (int i = 0; i < triangles; ++i) {
        const double reach = i % 5 == 0 ? 3000 : 12;
        std::vector<Corner> ring(3);
        for (Corner& c : ring) {
            c = {16 + random.uniform(-reach, reach), 16 + random.uniform(-reach, reach)};
            if (i % 3 != 0) c = {std::round(c.x * 4) / 4, std::round(c.y * 4) / 4};
        }
        if (i % 4 == 0) make_right_angled(ring);
        const auto result = covers_ring_once(coverage(front, {{ring[0], ring[1], ring[2]}}, state),
                                             snapped_ring(ring, state.viewport));
        if (!result) return testing::AssertionFailure() << i << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

std::vector<int> totals(const FrontEnd& front, const std::vector<Corners>& triangles,
                        const RasterState& state) {
    std::vector<int> result;
    for (const Corners& corners : triangles)
        result.push_back(coverage(front, {corners}, state).total());
    return result;
}

testing::AssertionResult published_examples(const FrontEnd& front) {
    const auto fails = [](const char* what) { return testing::AssertionFailure() << what; };
    const RasterState four = y_down(4, 4), eight = y_down(8, 8);
    const Corner a{0, 0}, b{4, 0}, c{4, 4}, d{0, 4};
    if (totals(front, {{a, b, c}, {a, c, d}}, four) != std::vector{10, 6})
        return fails("diagonal split");
    if (totals(front, {{a, b, d}, {b, c, d}}, four) != std::vector{6, 10})
        return fails("anti-diagonal split");
    const Corner e{.5, .5}, f{2.5, .5}, g{2.5, 2.5}, h{.5, 2.5};
    const CoverageMap rect = coverage(front, {{e, f, g}, {e, g, h}}, four);
    if (rect.total() != 4 || rect.at(0, 0) + rect.at(1, 0) + rect.at(0, 1) + rect.at(1, 1) != 4)
        return fails("half-pixel rectangle");
    const Corner p{0, 0}, q{5, 0}, r{5, 5}, s{0, 5}, apex{2.5, 2.5};
    if (totals(front, {{p, q, apex}, {q, r, apex}, {r, s, apex}, {s, p, apex}}, eight) !=
        std::vector{6, 9, 6, 4})
        return fails("fan on a pixel centre");
    if (coverage(front, {{q, r, apex}}, eight).at(2, 2) != 1) return fails("owner of the apex");
    if (totals(front, {{Corner{0, 0}, Corner{8, 0.001}, Corner{4, 0}}}, eight)[0] != 0)
        return fails("sliver");
    // 10.4990234375 snaps to 10.5, a left edge on the centre of pixel 10.
    const CoverageMap edge =
        coverage(front, {{Corner{10.4990234375, 0}, Corner{14, 0}, Corner{10.4990234375, 14}}},
                 y_down(16, 16));
    return edge.at(10, 0) == 1 ? testing::AssertionSuccess() : fails("snapped left edge");
}

/// Counter-clockwise on the screen is front in all conventions.
testing::AssertionResult faces_as_seen(const FrontEnd& front) {
    for (Conventions conventions : {Conventions::gl, Conventions::vulkan, Conventions::d3d}) {
        RasterState state = y_down(8, 8);
        state.viewport.conventions = conventions;
        const double up = conventions == Conventions::gl ? 1 : -1;
        const Corners counter_clockwise{Corner{1, 4}, Corner{6, 4}, Corner{1, 4 + 3 * up}};
        const Corners clockwise{counter_clockwise[0], counter_clockwise[2], counter_clockwise[1]};
        ScreenTriangle t;
        front.set_up(to_clip(counter_clockwise, state.viewport), state, t);
        if (!t.front_facing) return testing::AssertionFailure() << "front is back";
        front.set_up(to_clip(clockwise, state.viewport), state, t);
        if (t.front_facing) return testing::AssertionFailure() << "back is front";
    }
    return testing::AssertionSuccess();
}

TEST(Fill, PublishedExamples) {
    EXPECT_TRUE(published_examples(front_end()));
    EXPECT_FALSE(published_examples(front_end(Planted::bottom_right_rule)));
    EXPECT_FALSE(published_examples(front_end(Planted::inclusive_edges)));
}

TEST(Fill, FansAreWatertight) {
    EXPECT_TRUE(fans_are_watertight(front_end(), 10000));
    for (Planted planted :
         {Planted::inclusive_edges, Planted::exclusive_edges, Planted::bottom_right_rule,
          Planted::slivers_dropped, Planted::one_winding_only, Planted::corner_test_only})
        EXPECT_FALSE(fans_are_watertight(front_end(planted), 300)) << int(planted);
}

TEST(Fill, MeshesAreWatertight) {
    EXPECT_TRUE(meshes_are_watertight(front_end(), 60));
    for (Planted planted :
         {Planted::inclusive_edges, Planted::exclusive_edges, Planted::corner_test_only})
        EXPECT_FALSE(meshes_are_watertight(front_end(planted), 5)) << int(planted);
}

TEST(Fill, AgreesWithMovedSamples) {
    for (Conventions conventions : {Conventions::gl, Conventions::vulkan, Conventions::d3d}) {
        EXPECT_TRUE(agrees_with_moved_samples(front_end(), conventions, 3000));
        for (Planted planted : {Planted::int32_edges, Planted::bottom_right_rule,
                                Planted::one_winding_only, Planted::corner_test_only})
            EXPECT_FALSE(agrees_with_moved_samples(front_end(planted), conventions, 300))
                << int(planted);
    }
}

TEST(Fill, HalfAwaySnappingMovesEdges) {
    // 1/512 + 10.5 is a tie between the sample of pixel 10 and a point right of it.
    const Corners corners{Corner{10.501953125, 0}, Corner{14, 0}, Corner{10.501953125, 14}};
    const RasterState state = y_down(16, 16);
    EXPECT_EQ(coverage(front_end(), {corners}, state).at(10, 0), 1);
    EXPECT_EQ(coverage(front_end(Planted::half_away_snapping), {corners}, state).at(10, 0), 0);
}

TEST(Fill, FacingIsAsSeen) {
    EXPECT_TRUE(faces_as_seen(front_end()));
    EXPECT_FALSE(faces_as_seen(front_end(Planted::facing_without_axes)));
}

TEST(Fill, PublishedFacing) {
    // Vulkan's a = -1/2: clockwise, back-facing when counter-clockwise is front.
    RasterState state = y_down(8, 8);
    const auto clip = to_clip({Corner{0, 0}, Corner{1, 0}, Corner{0, 1}}, state.viewport);
    ScreenTriangle t;
    EXPECT_EQ(set_up_triangle(clip, state, t), SetupOutcome::drawn);
    EXPECT_FALSE(t.front_facing);
    state.cull = Cull::back;
    EXPECT_EQ(set_up_triangle(clip, state, t), SetupOutcome::culled);
    state.cull = Cull::front;
    EXPECT_EQ(set_up_triangle(clip, state, t), SetupOutcome::drawn);
}

TEST(Fill, ZeroAreaIsNeverDrawn) {
    for (Cull cull : {Cull::none, Cull::back, Cull::front}) {
        RasterState state = y_down(8, 8);
        state.cull = cull;
        ScreenTriangle t;
        const auto clip = to_clip({Corner{0, 0}, Corner{8, 0.001}, Corner{4, 0}}, state.viewport);
        EXPECT_EQ(set_up_triangle(clip, state, t), SetupOutcome::zero_area);
    }
}

}  // namespace
}  // namespace quadrel::test
