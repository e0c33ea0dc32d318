#include "quadrel/raster/snap.hpp"

#include <cmath>
#include <limits>

#include "raster/support.hpp"

namespace quadrel::test {
namespace {

using Snap = std::function<std::int32_t(double, int)>;

Snap half_even(Planted planted = Planted::none) {
    return [planted](double x, int bits) {
        const bool away = planted == Planted::half_away_snapping;
        if (planted == Planted::nan_snaps_to_limit && x != x) return -snapped_limit;
        if (planted == Planted::truncating_snapping) x -= 0.5 / (1 << bits);
        return snap(x, bits, away ? SnapRounding::half_away : SnapRounding::half_even);
    };
}

testing::AssertionResult rounds_to_nearest_even(const Snap& snap_to, int bits) {
    const int unit = 256 >> bits;
    Random random;
    for (int i = 0; i < 20000; ++i) {
        // A third of the numbers are ties.
        const double grid = i % 3 == 0 ? random.below(1 << 20) - (1 << 19) + 0.5
                                       : random.uniform(-1 << 19, 1 << 19);
        const double steps = double(snap_to(grid / (1 << bits), bits)) / unit;
        const double off = std::fabs(steps - grid);
        if (steps != std::floor(steps) || off > 0.5 || (off == 0.5 && std::fmod(steps, 2.0) != 0))
            return testing::AssertionFailure() << grid << " went to " << steps;
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult survives_strange_values(const Snap& snap_to) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    if (snap_to(std::nan(""), 8) != 0) return testing::AssertionFailure() << "NaN";
    if (snap_to(inf, 8) != snapped_limit || snap_to(1e300, 4) != snapped_limit)
        return testing::AssertionFailure() << "upper limit";
    if (snap_to(-inf, 8) != -snapped_limit || snap_to(-1e300, 4) != -snapped_limit)
        return testing::AssertionFailure() << "lower limit";
    return testing::AssertionSuccess();
}

TEST(Snap, PublishedExamples) {
    const double x[] = {1.0 / 512, 3.0 / 512, -1.0 / 512, 5.0 / 512, 10.4990234375};
    const int even[] = {0, 2, 0, 2, 2688}, away[] = {1, 2, -1, 3};
    for (int i = 0; i < 5; ++i) EXPECT_EQ(snap(x[i]), even[i]);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(snap(x[i], 8, SnapRounding::half_away), away[i]);
}

TEST(Snap, RoundsToNearestEven) {
    for (int bits : {4, 8}) {
        EXPECT_TRUE(rounds_to_nearest_even(half_even(), bits));
        EXPECT_FALSE(rounds_to_nearest_even(half_even(Planted::half_away_snapping), bits));
        EXPECT_FALSE(rounds_to_nearest_even(half_even(Planted::truncating_snapping), bits));
    }
}

TEST(Snap, StrangeValues) {
    EXPECT_TRUE(survives_strange_values(half_even()));
    EXPECT_FALSE(survives_strange_values(half_even(Planted::nan_snaps_to_limit)));
}

}  // namespace
}  // namespace quadrel::test
