// The searches of Unity, PlayCanvas and three.js where a listing over ordinary maps does not lead.
#include "relief/engine/engine_checks.hpp"
#include "relief/engine/engine_listings_playcanvas.hpp"
#include "relief/engine/engine_listings_three.hpp"
#include "relief/engine/engine_listings_unity.hpp"

namespace quadrel::test {
namespace {

std::vector<Listing> parallax_engines() {
    std::vector<Listing> all = unity_listings();
    for (const auto& engine : {playcanvas_listings(), three_listings()})
        all.insert(all.end(), engine.begin(), engine.end());
    return all;
}

TEST(UnityPlayCanvasThree, FollowTheirListingsOnWildMaps) {
    for (const Listing& listing : parallax_engines()) {
        EXPECT_TRUE(follows_on_wild_maps(listing, {listing.id}));
        EXPECT_FALSE(
            follows_on_wild_maps(listing, flawed_behind(listing.id, Planted::fetch_not_counted)));
    }
}

// ---- How a search ends --------------------------------------------------------------------------

/// Every mode; PlayCanvas' occlusion with rays so long that none fades.
const std::vector<std::pair<std::string, Parameters>> modes = {
    {"unity-pom", {{"mode", 0}}},      {"unity-pom", {{"mode", 1}}},
    {"playcanvas", {{"mode", 0}}},     {"playcanvas", {{"mode", 1}, {"height_map_factor", 100}}},
    {"three-parallax", {{"mode", 0}}}, {"three-parallax", {{"mode", 1}}},
    {"three-parallax", {{"mode", 2}}}, {"three-parallax", {{"mode", 3}}},
    {"three-parallax-uv", {}}};

TEST(UnityPlayCanvasThree, HeightsThatAreNoNumbersAreSeen) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [id, parameters] : modes) {
        EXPECT_TRUE(ends_with({id}, parameters, 0.4f, Status::hit));
        EXPECT_TRUE(ends_with({id}, parameters, nan, Status::nan));
        EXPECT_FALSE(
            ends_with(flawed_behind(id, Planted::nan_is_floor), parameters, nan, Status::nan));
    }
}

testing::AssertionResult ends_at_the_floor(const std::string& id, const Parameters& parameters,
                                           float height) {
    if (ends_with(flawed_behind(id, Planted::surface_not_reached), parameters, height,
                  Status::floor))
        return testing::AssertionFailure() << "any end will do";
    return ends_with({id}, parameters, height, Status::floor);
}

/// Unity wants heights above the ray's, so that the bottom plane is none; PlayCanvas reaches it and
/// nothing below; three.js has 30 layers at most, enough for 25, too few for 60.
TEST(UnityPlayCanvasThree, HaveFloorsOfTheirOwn) {
    const Parameters eighths = {{"steps", 8}};  // steps without rounding
    EXPECT_TRUE(ends_at_the_floor("unity-pom", eighths, 0));
    EXPECT_FALSE(ends_at_the_floor("unity-pom", eighths, 0.001f));
    const Parameters occlusion = {{"mode", 1}, {"height_map_factor", 100}, {"samples", 1}};
    EXPECT_TRUE(ends_at_the_floor("playcanvas", occlusion, -0.01f));
    EXPECT_FALSE(ends_at_the_floor("playcanvas", occlusion, 0));
    for (const int mode : {1, 2, 3}) {
        EXPECT_TRUE(ends_at_the_floor(
            "three-parallax", {{"mode", mode}, {"min_layers", 60}, {"max_layers", 60}}, 0.4f));
        EXPECT_FALSE(ends_at_the_floor(
            "three-parallax", {{"mode", mode}, {"min_layers", 60}, {"max_layers", 60}}, 0.6f));
        EXPECT_FALSE(ends_at_the_floor("three-parallax", {{"mode", mode}}, 0));
    }
}

// ---- Flat maps ----------------------------------------------------------------------------------

testing::AssertionResult meets_flat_maps_alone(const std::string& id, const Parameters& parameters,
                                               const ShiftOf& shift_of, int size = 4) {
    if (meets_flat_maps(flawed_behind(id, Planted::off_the_ray), parameters, shift_of, size))
        return testing::AssertionFailure() << "any shift will do";
    return meets_flat_maps({id}, parameters, shift_of, size);
}

/// On the ray at the depth of the map, late by a share `late` of the range at most.
ShiftOf on_the_ray(double scale, double late = 0) {
    return [=](const dvec3& V, double height) -> Shift {
        const dvec2 range = dvec2(V) / V.z * scale;
        return {range * -(1 - height), length(range) * late};
    };
}
/// Not divided by z, from the height that stays where it is.
ShiftOf limited(double scale, double base) {
    return [=](const dvec3& V, double height) -> Shift {
        return {dvec2(V) * (scale * (height - base))};
    };
}

TEST(UnityPlayCanvasThree, UnityMeetsFlatMaps) {
    for (const int mode : {0, 1}) {
        EXPECT_TRUE(meets_flat_maps_alone("unity-pom",
                                          {{"mode", mode}, {"scale", 0.07}, {"lod_threshold", 5}},
                                          on_the_ray(0.07)));
    }
}

TEST(UnityPlayCanvasThree, OffsetsAreLimited) {
    EXPECT_TRUE(meets_flat_maps_alone("playcanvas", {{"height_map_factor", 0.7}, {"base", 0.3}},
                                      limited(0.07, 0.3)));
    EXPECT_TRUE(
        meets_flat_maps_alone("three-parallax", {{"mode", 0}, {"scale", 0.07}}, limited(0.07, 1)));
    EXPECT_TRUE(meets_flat_maps_alone("three-parallax-uv", {{"scale", 0.07}}, limited(0.07, 1)));
}

/// The number of layers is at least 10: late by one, not at all, or by a half halved 5 times.
TEST(UnityPlayCanvasThree, ThreeMeetsFlatMaps) {
    const auto mode = [](int value) -> Parameters {
        return {{"mode", value}, {"scale", 0.07}, {"min_layers", 10}, {"max_layers", 20}};
    };
    EXPECT_TRUE(meets_flat_maps_alone("three-parallax", mode(2), on_the_ray(0.07)));
    const ShiftOf steep = on_the_ray(0.07, 0.1), relief = on_the_ray(0.07, 0.1 / 64);
    EXPECT_TRUE(meets_flat_maps({"three-parallax"}, mode(1), steep));
    EXPECT_FALSE(meets_flat_maps({"three-parallax"}, mode(1), relief));
    EXPECT_TRUE(meets_flat_maps({"three-parallax"}, mode(3), relief));
    EXPECT_FALSE(meets_flat_maps({"three-parallax"}, mode(3), on_the_ray(0.07)));
}

/// PlayCanvas' occlusion over a map of 256 texels a side: the ray's slope is at most 5, steps are
/// two texels long, 16 at most, and rays of less than three texels fade.
ShiftOf playcanvas_shift(double scale, double base) {
    return [=](const dvec3& V, double height) -> Shift {
        const dvec2 ray = dvec2(V) / V.z * -scale;
        const dvec2 span = ray * std::min(1.0, 5 * scale / length(ray));
        const double texels = length(span) * 256;
        const double fade = std::clamp((texels - 1) / 2, 0.0, 1.0);
        const double step = 1 / std::clamp(texels / 2, 1.0, 16.0);
        return {span * ((base - height) * fade), length(span) * step * fade / 64};
    };
}

TEST(UnityPlayCanvasThree, PlayCanvasMeetsFlatMaps) {
    for (const double base : {0.0, 0.5, 1.0}) {
        const Parameters parameters = {{"mode", 1}, {"height_map_factor", 0.4}, {"base", base}};
        EXPECT_TRUE(meets_flat_maps({"playcanvas"}, parameters, playcanvas_shift(0.04, base), 256));
        EXPECT_FALSE(
            meets_flat_maps({"playcanvas"}, parameters, playcanvas_shift(0.04, base - 0.1), 256));
    }
}

// ---- No relief at all ---------------------------------------------------------------------------

TEST(UnityPlayCanvasThree, PlayCanvasSavesLookUpsWhereNothingMoves) {
    const auto occlusion = [](double factor) -> Parameters {
        return {{"mode", 1}, {"height_map_factor", factor}};
    };
    EXPECT_TRUE(leaves_the_polygon_alone({"playcanvas"}, occlusion(0.001)));
    EXPECT_FALSE(leaves_the_polygon_alone({"playcanvas"}, occlusion(10)));
    EXPECT_FALSE(leaves_the_polygon_alone({"playcanvas"}, {}));
}

/// The search is made, and its offset does not count.
testing::AssertionResult shrinks_to_nothing(const Parameters& parameters) {
    Inputs inputs(4);
    Batch<float>& b = inputs.batch;
    b.run("unity-pom", parameters);
    for (int lane = 0; lane < b.lanes; ++lane) {
        if (b.vector2(Value::uv, lane) != b.vector2(Value::hit_uv, lane))
            return testing::AssertionFailure() << "lane " << lane << " moved";
        if (b.integer(Value::hit_fetches, lane) < 3)
            return testing::AssertionFailure() << "lane " << lane << " saved look-ups";
    }
    return testing::AssertionSuccess();
}

TEST(UnityPlayCanvasThree, UnitysOffsetShrinksWithinALevel) {
    EXPECT_TRUE(shrinks_to_nothing({{"lod", 2}, {"lod_threshold", 1}}));
    EXPECT_TRUE(shrinks_to_nothing({{"lod", 2}, {"lod_threshold", 0.5}}));
    EXPECT_FALSE(shrinks_to_nothing({{"lod", 2}, {"lod_threshold", 1.5}}));
    EXPECT_FALSE(shrinks_to_nothing({{"lod", 2}, {"lod_threshold", 2}}));
}

}  // namespace
}  // namespace quadrel::test
