// The marches in layers of Godot, Bevy and Learn OpenGL where a listing over ordinary maps does not
// lead: maps deeper than the relief, heights that are no numbers, flat maps, and how a search says
// that it ended.
#include "relief/engine/engine_checks.hpp"
#include "relief/engine/engine_listings_bevy.hpp"
#include "relief/engine/engine_listings_godot.hpp"
#include "relief/engine/engine_listings_learnopengl.hpp"

namespace quadrel::test {
namespace {

using Stage = StageUnderTest<float>;

std::vector<Listing> layered_engines() {
    std::vector<Listing> all = godot_listings();
    for (const auto& engine : {bevy_listings(), learnopengl_listings()})
        all.insert(all.end(), engine.begin(), engine.end());
    return all;
}

// ---- Any heights --------------------------------------------------------------------------------

TEST(LayeredEngines, FollowTheirListingsOnWildMaps) {
    for (const Listing& listing : layered_engines()) {
        EXPECT_TRUE(follows_on_wild_maps(listing, {listing.id}));
        EXPECT_FALSE(
            follows_on_wild_maps(listing, flawed_behind(listing.id, Planted::fetch_not_counted)));
    }
}

// ---- How a search ends --------------------------------------------------------------------------

TEST(LayeredEngines, SayHowTheyEnded) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Listing& listing : layered_engines()) {
        const auto ends = [&](const Stage& stage, float height, Status expected) {
            return ends_with(stage, listing.parameters, height, expected);
        };
        EXPECT_TRUE(ends({listing.id}, 0.4f, Status::hit));
        EXPECT_TRUE(ends({listing.id}, nan, Status::nan));
        EXPECT_FALSE(ends(flawed_behind(listing.id, Planted::nan_is_floor), nan, Status::nan));
        if (listing.id != "bevy") continue;
        // Bevy's loop is left behind the bottom plane, the others march on.
        EXPECT_TRUE(ends({listing.id}, -3, Status::floor));
        EXPECT_FALSE(
            ends(flawed_behind(listing.id, Planted::surface_not_reached), -3, Status::floor));
    }
}

/// Between infinite and other heights secants are no numbers: the depth of a hit is one, if an
/// infinite one where it is made of a single height.
TEST(LayeredEngines, HitsAreSomewhereBesideInfiniteHeights) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    int hits = 0, nans = 0;
    for (const Listing& listing : layered_engines())
        for (int seed = 0; seed < 8; ++seed) {
            Inputs inputs(seed);
            const Map map = height_map(32, 32, [&](int, int) {
                return inputs.random.chance(0.1) ? infinity
                       : inputs.random.chance(0.1)
                           ? -infinity
                           : static_cast<float>(inputs.random.uniform(-1, 1));
            });
            inputs.batch.bind(TextureSlot::height, map.sampled);
            inputs.batch.run(listing.id, listing.parameters);
            for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
                const int status = inputs.batch.integer(Value::hit_status, lane);
                nans += status == static_cast<int>(Status::nan);
                if (inputs.batch.active[std::size_t(lane)] == 0 ||
                    status != static_cast<int>(Status::hit))
                    continue;
                ++hits;
                EXPECT_FALSE(std::isnan(inputs.batch.real(Value::hit_s, lane))) << listing.id;
            }
        }
    EXPECT_GT(hits, 0);
    EXPECT_GT(nans, 0);
}

TEST(LayeredEngines, LoopsWithoutAnEndAreCutOff) {
    const float bottomless = -1e30f;
    for (const Listing& listing : {godot(true, 5, 8, 32), learnopengl(0.1f, 8, 32)}) {
        const auto ends = [&](const Stage& stage, float height, Status expected) {
            return ends_with(stage, listing.parameters, height, expected);
        };
        EXPECT_TRUE(ends({listing.id}, bottomless, Status::cap));
        EXPECT_TRUE(ends({listing.id}, -3, Status::hit));
        EXPECT_FALSE(
            ends(flawed_behind(listing.id, Planted::surface_not_reached), bottomless, Status::cap));
    }
}

// ---- Flat maps ----------------------------------------------------------------------------------

/// The view vector that a listing's fragments have: Learn OpenGL's comes from its vertex shader.
dvec3 view_of(const Listing& listing, Batch<float>& batch, int lane) {
    if (listing.id != "learnopengl") return dvec3(tangent_view(batch, lane));
    return dvec3(normalize(-tangent_frag_pos(batch, lane)));
}

/// On a flat map the ray ends where its line meets the height: the offset is `scale` times the
/// depth times V.xy, which Godot does not divide by V.z, as the others do. `within`: in shares of
/// scale.
testing::AssertionResult meets_a_flat_map(const Listing& listing, const Stage& stage,
                                          double within) {
    const double unit = listing.id == "godot" ? 0.01 : 1;
    const double scale = listing.parameters.at("scale") * unit;
    for (const float height : {0.03f, 0.5f, 0.93f}) {
        Inputs inputs(7);
        Batch<float>& b = inputs.batch;
        const Map map = flat_map(height);
        b.bind(TextureSlot::height, map.sampled);
        stage.run(b, listing.parameters);
        for (int lane = 0; lane < b.lanes; ++lane) {
            const dvec3 V = view_of(listing, b, lane);
            const double slope = (1.0 - height) / (listing.id == "godot" ? 1 : V.z);
            const dvec2 offset = dvec2(V) * (scale * slope);
            const dvec2 expected = dvec2(b.vector2(Value::uv, lane)) - offset;
            const dvec2 error = dvec2(b.vector2(Value::hit_uv, lane)) - expected;
            // Rounding apart, errors along the ray grow as its slope does.
            const double rounding = 1e-5 * std::max(1.0, length(offset));
            if (length(error) > rounding + within * std::abs(scale / V.z))
                return testing::AssertionFailure() << listing.id << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(LayeredEngines, MeetFlatMaps) {
    for (const Listing& listing : layered_engines()) {
        const bool half_steps = listing.id == "bevy" && listing.parameters.at("relief") == 1;
        // Half a layer at most, and at most the whole range is one, then halved again and again.
        const int steps = half_steps ? static_cast<int>(listing.parameters.at("relief_steps")) : 0;
        const double within = half_steps ? std::ldexp(1.0, -steps - 1) : 0;
        EXPECT_TRUE(meets_a_flat_map(listing, {listing.id}, within));
        if (half_steps) continue;
        EXPECT_FALSE(
            meets_a_flat_map(listing, flawed_behind(listing.id, Planted::off_the_ray), within));
    }
    const Listing many = bevy(true, 20, 16, 0.1f);
    EXPECT_TRUE(meets_a_flat_map(many, {"bevy"}, 0));
    EXPECT_FALSE(meets_a_flat_map(bevy(true, 4, 16, 0.1f), {"bevy"}, 0));
}

// ---- No layers ----------------------------------------------------------------------------------

TEST(LayeredEngines, BevyWithoutALayerHasNoParallax) {
    EXPECT_TRUE(leaves_the_polygon_alone({"bevy"}, {{"max_layers", 0.99}}));
    EXPECT_TRUE(leaves_the_polygon_alone({"bevy"}, {{"max_layers", 0}}));
    EXPECT_FALSE(leaves_the_polygon_alone({"bevy"}, {{"max_layers", 1}}));
}

}  // namespace
}  // namespace quadrel::test
