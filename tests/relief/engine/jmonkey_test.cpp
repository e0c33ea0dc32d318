// jMonkeyEngine's parallax where a listing over ordinary maps does not lead: wild and flat maps,
// the view along the normal, and how the search says that it ended.
#include "relief/engine/engine_checks.hpp"
#include "relief/engine/engine_listings_jmonkey.hpp"

namespace quadrel::test {
namespace {

const Parameters classic = {{"steep", 0}}, steep_mode = {{"steep", 1}};

TEST(JMonkey, FollowsItsListingsOnWildMaps) {
    for (const Listing& listing : jmonkey_listings()) {
        EXPECT_TRUE(follows_on_wild_maps(listing, {listing.id}));
        EXPECT_FALSE(
            follows_on_wild_maps(listing, flawed_behind(listing.id, Planted::fetch_not_counted)));
    }
}

TEST(JMonkey, SaysHowItEnded) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Parameters& mode : {classic, steep_mode}) {
        EXPECT_TRUE(ends_with({"jmonkey"}, mode, 0.4f, Status::hit));
        EXPECT_TRUE(ends_with({"jmonkey"}, mode, nan, Status::nan));
        EXPECT_FALSE(
            ends_with(flawed_behind("jmonkey", Planted::nan_is_floor), mode, nan, Status::nan));
    }
    EXPECT_TRUE(ends_with({"jmonkey"}, steep_mode, -3, Status::floor));
    EXPECT_FALSE(ends_with(flawed_behind("jmonkey", Planted::surface_not_reached), steep_mode, -3,
                           Status::floor));
}

TEST(JMonkey, SteepIsLostAlongTheNormal) {
    EXPECT_TRUE(is_nan_seen_along_the_normal({"jmonkey"}, steep_mode));
    EXPECT_FALSE(is_nan_seen_along_the_normal({"jmonkey"}, classic));
}

/// A flat map at the very height that the ray has at the first sample: the second one ends it.
testing::AssertionResult passes_a_height_on_the_ray(const StageUnderTest<float>& stage) {
    Inputs inputs(2);
    Batch<float>& b = inputs.batch;
    place_all_at(b, dvec3(-1, 0.5, -2));
    const float samples =
        mix(6.0f, 1000.0f * (0.05f * 0.3f), 1.0f - normalize(tangent_view(b, 0)).z);
    const Map map = flat_map(1.0f - 1.0f / samples);
    b.bind(TextureSlot::height, map.sampled);
    stage.run(b, steep_mode);
    for (int lane = 0; lane < b.lanes; ++lane) {
        const int fetches = b.integer(Value::hit_fetches, lane);
        if (fetches != 2) return testing::AssertionFailure() << fetches << " look-ups";
    }
    return testing::AssertionSuccess();
}

TEST(JMonkey, SteepPassesHeightsOnTheRay) {
    EXPECT_TRUE(passes_a_height_on_the_ray({"jmonkey"}));
    EXPECT_FALSE(passes_a_height_on_the_ray(flawed_behind("jmonkey", Planted::fetch_not_counted)));
}

// ---- Flat maps ----------------------------------------------------------------------------------

/// Towards the viewer by the height above 0.6, times z.
ShiftOf classic_shift(double scale, double base) {
    return [=](const dvec3& V, double height) -> Shift {
        const dvec3 unit = normalize(V);
        return {dvec2(unit) * (unit.z * scale * (height - base)), 0};
    };
}

/// On the ray at the map's height in 0.3 of the scale; but the first step starts from a height of 0
/// if `from_0`, and so ends on a line from there.
ShiftOf steep_shift(double scale, bool from_0) {
    return [=](const dvec3& V, double height) -> Shift {
        const double t = 1 - normalize(V).z, range = 0.3 * scale;
        const double step = 1 / (6 * (1 - t) + 1000 * range * t);
        const bool in_first = from_0 && height > 1 - step;
        const double depth = in_first ? step / (step + height) : 1 - height;
        return {dvec2(V) / V.z * (-range * depth), 0};
    };
}

TEST(JMonkey, MeetsFlatMaps) {
    const Parameters shallow = {{"steep", 0}, {"scale", 0.1}},
                     deep = {{"steep", 1}, {"scale", 0.3}};
    EXPECT_TRUE(meets_flat_maps({"jmonkey"}, shallow, classic_shift(0.1, 0.6)));
    EXPECT_FALSE(meets_flat_maps({"jmonkey"}, shallow, classic_shift(0.1, 0.5)));
    EXPECT_TRUE(meets_flat_maps({"jmonkey"}, deep, steep_shift(0.3, true)));
    EXPECT_FALSE(meets_flat_maps({"jmonkey"}, deep, steep_shift(0.3, false)));
    for (const auto& [mode, shift] :
         {std::pair(shallow, classic_shift(0.1, 0.6)), std::pair(deep, steep_shift(0.3, true))})
        EXPECT_FALSE(meets_flat_maps(flawed_behind("jmonkey", Planted::off_the_ray), mode, shift));
}

}  // namespace
}  // namespace quadrel::test
