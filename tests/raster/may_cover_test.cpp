// Triangles between the samples: what is left out covers none, and most that cover none are left
// out.
#include "raster/support.hpp"

namespace quadrel::test {
namespace {

using MayCover = std::function<bool(const ScreenTriangle&, int)>;

/// Of small triangles, some of them on the grid of samples.
ScreenTriangle small_triangle(Random& random, double size) {
    const RasterState state = y_down(16, 16);
    for (;;) {
        const double x = random.uniform(1, 14), y = random.uniform(1, 14);
        Corners corners;
        for (Corner& c : corners) {
            c = {x + random.uniform(0, size), y + random.uniform(0, size)};
            if (random.below(4) == 0) c = {std::round(c.x * 16) / 16, std::round(c.y * 16) / 16};
        }
        ScreenTriangle triangle;
        if (set_up_triangle(to_clip(corners, state.viewport), state, triangle) ==
            SetupOutcome::drawn)
            return triangle;
    }
}

bool covers_any(const ScreenTriangle& triangle, int samples) {
    for (int y = triangle.bounds.y0; y < triangle.bounds.y1; ++y)
        for (int x = triangle.bounds.x0; x < triangle.bounds.x1; ++x)
            if (coverage_mask(triangle, x, y, samples) != 0) return true;
    return false;
}

testing::AssertionResult loses_nothing(const MayCover& may_cover) {
    Random random;
    int left_out = 0;
    for (int i = 0; i < 4000; ++i) {
        const double size = i % 4 == 0 ? 5 : 0.6;
        const int samples = 1 << random.below(5);
        const ScreenTriangle triangle = small_triangle(random, size);
        const bool kept = may_cover(triangle, samples);
        if (!kept && covers_any(triangle, samples))
            return testing::AssertionFailure() << "triangle " << i << " of " << samples;
        left_out += !kept;
    }
    if (left_out < 500) return testing::AssertionFailure() << "only " << left_out << " left out";
    return testing::AssertionSuccess();
}

TEST(MayCover, LeavesOutWhatCoversNothing) { EXPECT_TRUE(loses_nothing(may_cover)); }

TEST(MayCover, LostSamplesAreNoticed) {
    // As if there were the pixels' centres alone.
    EXPECT_FALSE(loses_nothing([](const ScreenTriangle& t, int) { return may_cover(t, 1); }));
    EXPECT_FALSE(loses_nothing([](const ScreenTriangle&, int) { return true; }));
}

}  // namespace
}  // namespace quadrel::test
