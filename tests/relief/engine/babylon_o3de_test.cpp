// The searches of Babylon.js and O3DE where a listing over ordinary maps does not lead: flat and
// wild maps, which way the frame points, ranges above the polygon, and how a search ends.
#include "relief/engine/engine_checks.hpp"
#include "relief/engine/engine_listings_babylon.hpp"
#include "relief/engine/engine_listings_o3de.hpp"

namespace quadrel::test {
namespace {

// ---- Any heights --------------------------------------------------------------------------------

TEST(BabylonO3de, FollowTheirListingsOverAnyHeights) {
    std::vector<Listing> all = {babylon(false, 0.05f, false, false),
                                babylon(true, 0.1f, false, false)};
    for (int algorithm = 0; algorithm < 5; ++algorithm)
        all.push_back(o3de(algorithm, 0, 0.1f, 0.03f));
    for (const Listing& listing : all) {
        EXPECT_TRUE(follows_on_wild_maps(listing, {listing.id}));
        EXPECT_FALSE(
            follows_on_wild_maps(listing, flawed_behind(listing.id, Planted::fetch_not_counted)));
    }
}

// ---- How a search ends --------------------------------------------------------------------------

TEST(BabylonO3de, HeightsThatAreNoNumbersAreSeen) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto seen = [&](const std::string& id, const char* mode, int value) {
        const Parameters parameters = {{mode, value}};
        EXPECT_TRUE(ends_with({id}, parameters, 0.9f, Status::hit));
        EXPECT_TRUE(ends_with({id}, parameters, nan, Status::nan));
        EXPECT_FALSE(
            ends_with(flawed_behind(id, Planted::nan_is_floor), parameters, nan, Status::nan));
    };
    for (const int occlusion : {0, 1}) seen("babylon", "parallax_occlusion", occlusion);
    for (int algorithm = 0; algorithm < 5; ++algorithm) seen("o3de", "algorithm", algorithm);
}

/// So thin and so high a range that the march would be the longer for it: the polygon lies 80000
/// ranges below the top.
TEST(BabylonO3de, O3desLoopsAreCutOff) {
    for (const int algorithm : {1, 4}) {
        const Parameters endless = {{"algorithm", algorithm}, {"scale", 0.0002}, {"offset", 16}};
        EXPECT_TRUE(ends_with({"o3de"}, endless, 0.5f, Status::cap));
        EXPECT_FALSE(ends_with(flawed_behind("o3de", Planted::surface_not_reached), endless, 0.5f,
                               Status::cap));
    }
}

// ---- Flat maps ----------------------------------------------------------------------------------

/// Basic: limited. The others: on the ray at the map's depth, or at the polygon if that is lower;
/// late by a step at most, but relief by what halving leaves, contact by a step's square.
ShiftOf o3de_shift(int algorithm, int steps, double factor, double offset) {
    return [=](const dvec3& V, double height) -> Shift {
        const dvec2 in_plane(V);
        if (algorithm == 0) return {in_plane * -((1 - height) * factor), 0};
        const double below = std::max(factor * (1 - height) - offset, 0.0);
        const double late[] = {0, 1.0 / steps, 0, std::ldexp(1.0, -steps) / steps,
                               1.0 / steps / steps};
        return {in_plane / V.z * -below, late[algorithm] * factor / V.z};
    };
}

TEST(BabylonO3de, O3deMeetsFlatMaps) {
    for (int algorithm = 0; algorithm < 5; ++algorithm) {
        for (const double offset : {0.0, -0.02, 0.02, 0.06}) {
            const Parameters parameters = {
                {"algorithm", algorithm}, {"quality", 2}, {"offset", offset}};
            const ShiftOf shift = o3de_shift(algorithm, 64, 0.05, offset);
            EXPECT_TRUE(meets_flat_maps({"o3de"}, parameters, shift)) << algorithm << offset;
            EXPECT_FALSE(
                meets_flat_maps(flawed_behind("o3de", Planted::off_the_ray), parameters, shift));
        }
    }
}

/// Plain: towards the viewer by the height. Occlusion: on the ray where it meets the height, or
/// after 15 of its 15 + 11 N.V steps, away from the viewer.
ShiftOf babylon_shift(bool occlusion) {
    return [=](const dvec3& V, double height) -> Shift {
        const dvec2 in_plane(V);
        if (!occlusion) return {in_plane * (0.05 * height), 0};
        const double steps = 15 + 11 * V.z;
        const double depth = 1 - height < 14 / steps ? 1 - height : 15 / steps;
        return {in_plane / V.z * (-0.05 * depth), 0};
    };
}

TEST(BabylonO3de, BumpsAreBumpsInBabylonsOwnFrame) {
    for (const bool occlusion : {false, true}) {
        const ShiftOf shift = babylon_shift(occlusion);
        const auto handed = [&](int right, int own_tangents) -> Parameters {
            return {{"parallax_occlusion", occlusion},
                    {"right_handed", right},
                    {"own_tangents", own_tangents}};
        };
        EXPECT_TRUE(meets_flat_maps({"babylon"}, handed(0, 0), shift));
        EXPECT_TRUE(meets_flat_maps({"babylon"}, handed(1, 0), shift));
        EXPECT_TRUE(meets_flat_maps({"babylon"}, handed(1, 1), shift));
        // The mesh's tangents and the signs of the default system do not agree.
        EXPECT_FALSE(meets_flat_maps({"babylon"}, handed(0, 1), shift));
    }
}

TEST(BabylonO3de, BabylonStopsShortOfTheBottom) {
    EXPECT_TRUE(ends_with({"babylon"}, {{"parallax_occlusion", 1}}, 0, Status::floor));
    EXPECT_FALSE(ends_with(flawed_behind("babylon", Planted::surface_not_reached),
                           {{"parallax_occlusion", 1}}, 0, Status::floor));
}

// ---- Special views and ranges -------------------------------------------------------------------

TEST(BabylonO3de, BabylonsOcclusionIsLostAlongTheNormal) {
    EXPECT_TRUE(is_nan_seen_along_the_normal({"babylon"}, {{"parallax_occlusion", 1}}));
    EXPECT_FALSE(is_nan_seen_along_the_normal({"babylon"}, {{"parallax_occlusion", 0}}));
    EXPECT_FALSE(is_nan_seen_along_the_normal({"o3de"}, {}));
}

testing::AssertionResult is_flat(const Parameters& parameters) {
    Inputs inputs(3);
    Batch<float>& b = inputs.batch;
    b.run("o3de", parameters);
    for (int lane = 0; lane < b.lanes; ++lane) {
        const Vec2 uv = b.vector2(Value::uv, lane), hit_uv = b.vector2(Value::hit_uv, lane);
        if (!same(uv.x, hit_uv.x) || !same(uv.y, hit_uv.y) ||
            b.integer(Value::hit_fetches, lane) != 1)
            return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(BabylonO3de, O3deTakesThinRangesToBeFlat) {
    for (int algorithm = 0; algorithm < 5; ++algorithm) {
        for (const double factor : {0.0, 0.00009})
            EXPECT_TRUE(is_flat({{"algorithm", algorithm}, {"scale", factor}, {"offset", 0.1}}));
        EXPECT_FALSE(is_flat({{"algorithm", algorithm}, {"scale", 0.05}}));
    }
}

}  // namespace
}  // namespace quadrel::test
