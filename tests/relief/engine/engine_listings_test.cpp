// The searches named after an engine give the bits of its shader.
#include "relief/engine/engine_listings.hpp"
#include "effort.hpp"

#include "relief/engine/engine_listings_babylon.hpp"
#include "relief/engine/engine_listings_bevy.hpp"
#include "relief/engine/engine_listings_godot.hpp"
#include "relief/engine/engine_listings_jmonkey.hpp"
#include "relief/engine/engine_listings_learnopengl.hpp"
#include "relief/engine/engine_listings_o3de.hpp"
#include "relief/engine/engine_listings_playcanvas.hpp"
#include "relief/engine/engine_listings_three.hpp"
#include "relief/engine/engine_listings_unity.hpp"
#include "relief/listing_runs.hpp"

namespace quadrel::test {
namespace {

Listing unreal(float ratio, float plane) {
    const auto run = [=](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::unreal(b.vector2(Value::uv, lane), tangent_eye(b, lane), ratio, plane,
                                    undisplaced_level(b, lane));
        });
    };
    return {"unreal-bump-offset",
            run,
            {{"height_ratio", ratio}, {"reference_plane", plane}},
            "offset-limit"};
}

std::vector<Listing> engine_listings() {
    std::vector<Listing> all = {unreal(0.05f, 0.5f), unreal(-0.1f, 0.2f)};
    for (const auto& engine : {godot_listings(), bevy_listings(), learnopengl_listings(),
                               babylon_listings(), o3de_listings(), playcanvas_listings(),
                               three_listings(), unity_listings(), jmonkey_listings()})
        all.insert(all.end(), engine.begin(), engine.end());
    return all;
}

TEST(EngineListings, AreReproducedBitForBit) {
    for (const Listing& listing : engine_listings())
        EXPECT_TRUE(equals_listing(listing, {listing.id}, rounds(40)));
}

TEST(EngineListings, ErrorsAreCaught) {
    for (const Listing& listing : engine_listings()) {
        EXPECT_FALSE(equals_listing(listing, {listing.corrected}, 5)) << listing.id;
        for (const Planted planted : {Planted::one_sample_early, Planted::steps_counted_once})
            EXPECT_FALSE(equals_listing(listing, flawed(listing.id, planted), 1)) << listing.id;
        EXPECT_TRUE(notices_the_ray(listing));
    }
}

}  // namespace
}  // namespace quadrel::test
