// The maps that sweeps make: what each promises.
#include "sweep/plan/map_kinds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sweep/planted.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;
using Heights = std::vector<float>;

Heights made(const std::string& name, int size, MapValues values = {}) {
    const MapKind* kind = find_map_kind(name);
    for (const MapParameter& parameter : kind->parameters)
        values.try_emplace(std::string(parameter.name), parameter.standard);
    return kind->make(size, values);
}

double at(const Heights& heights, int size, int x, int y) {
    return heights[static_cast<std::size_t>(y * size + x)];
}

TEST(MapKinds, HeightsLieFromZeroToOneUnlessTheyArePromisedNotTo) {
    for (const MapKind& kind : map_kinds()) {
        const std::string name(kind.name);
        int outside = 0, unknown = 0;
        const Heights heights = made(name, 32);
        EXPECT_EQ(heights.size(), 32u * 32u);
        for (const float height : heights) {
            unknown += std::isnan(height);
            outside += height < 0 || height > 1;
        }
        EXPECT_EQ(unknown, name == "nan" ? 1 : 0) << name;
        EXPECT_EQ(outside > 0, name == "outside") << name;
    }
}

TEST(MapKinds, AreTheSameEachTime) {
    for (const MapKind& kind : map_kinds()) {
        const std::string name(kind.name);
        if (name == "nan") continue;  // which equals nothing
        EXPECT_EQ(made(name, 16), made(name, 16)) << name;
    }
    EXPECT_NE(made("noise", 16), made("noise", 16, {{"seed", 1}}));
}

TEST(MapKinds, FlatIsFlat) {
    for (const double level : {0.0, 0.5, 1.0})
        for (const float height : made("flat", 8, {{"level", level}})) EXPECT_EQ(height, level);
}

/// Walls along v are one texel thick, `pitch` apart.
testing::AssertionResult are_thin(const Heights& heights, int size, int pitch) {
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (at(heights, size, x, y) != (x % pitch == 0 ? 1 : 0))
                return testing::AssertionFailure() << x << " " << y;
    return testing::AssertionSuccess();
}

TEST(MapKinds, WallsAreOneTexelThick) {
    Heights walls = made("walls", 32, {{"pitch", 8}, {"direction", 1}});
    EXPECT_TRUE(are_thin(walls, 32, 8));
    walls[5 * 32 + 9] = 1;
    EXPECT_FALSE(are_thin(walls, 32, 8)) << static_cast<int>(Planted::wall_too_thick);
    const Heights diagonal = made("walls", 32, {{"pitch", 8}, {"direction", 3}});
    EXPECT_EQ(at(diagonal, 32, 3, 5), 1);
    EXPECT_EQ(at(diagonal, 32, 3, 6), 0);
}

TEST(MapKinds, EachIsWhatItIsCalled) {
    const Heights ramp = made("ramp", 16), comb = made("comb", 16), cliff = made("cliff", 16),
                  checker = made("checker", 16), steps = made("steps", 64, {{"count", 4}});
    for (int x = 1; x < 16; ++x) {
        EXPECT_GT(at(ramp, 16, x, 3), at(ramp, 16, x - 1, 3));
        EXPECT_NE(at(comb, 16, x, 0), at(comb, 16, x - 1, 0));
        EXPECT_NE(at(checker, 16, x, 2), at(checker, 16, x - 1, 2));
    }
    EXPECT_EQ(at(cliff, 16, 7, 4), 0);
    EXPECT_EQ(at(cliff, 16, 8, 4), 1);
    EXPECT_EQ(std::set<float>(steps.begin(), steps.end()).size(), 5u);
    double sum = 0;
    for (const float height : made("impulse", 16)) sum += height;
    EXPECT_EQ(sum, 1);
}

/// Means stay: a map of the data directory at another size is the same map.
TEST(MapKinds, MapsOfTheDataDirectoryKeepTheirMean) {
    for (const char* name : {"bricks", "stones", "text", "city"}) {
        double small = 0, large = 0;
        for (const float height : made(name, 16)) small += height / (16 * 16);
        for (const float height : made(name, 64)) large += height / (64 * 64);
        EXPECT_NEAR(small, large, 0.01) << name;
    }
}

}  // namespace
}  // namespace quadrel::sweep_tests
