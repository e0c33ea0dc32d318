// Self-shadowing against a loop over plain numbers, and on maps whose shadows are known.
#include "effort.hpp"
#include "relief/facet.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using Shadow = StageUnderTest<float>;

// ---- The same march over plain numbers ----------------------------------------------------------

struct Shade {
    float visibility;
    int steps;
};

Shade shade_of(Batch<float>& batch, int lane, int n, Planted planted) {
    const LightUniforms& light = batch.frame.lights[0];
    const vec3<float> position(light.position[0], light.position[1], light.position[2]);
    const vec3<float> L =
        normalize(light.directional ? position : position - batch.vector3(Value::hit_P, lane));
    const float r = dot(L, batch.vector3(Value::frame_normal, lane));
    if (!(r > 0)) return {planted == Planted::unlit_side_visible ? 1.0f : 0.0f, 0};
    const float depth = batch.material.depth,
                side = planted == Planted::shadow_of_the_mirror ? -1 : 1;
    const vec2<float> K(dot(batch.vector3(Value::J, lane), L) / r * depth * side,
                        dot(batch.vector3(Value::J, lane, 3), L) / r * depth * side);
    const vec2<float> uv = batch.vector2(Value::hit_uv, lane);
    // Planted: without the max, the ray starts where the search stopped, below the surface.
    float z = 1 - batch.real(Value::hit_s, lane);
    if (planted != Planted::shadow_acne) z = max(z, batch.real(Value::hit_h, lane));
    for (int k = 1; k < n && depth != 0; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(n);
        if (!(z + t < 1)) return {1, k - 1};
        const float h = height_at(batch, lane, {uv.x + K.x * t, uv.y + K.y * t});
        if (h > z + t) return {0, k};
    }
    return {1, depth != 0 ? n - 1 : 0};
}

Shadow march(Planted planted = Planted::none) {
    if (planted == Planted::none) return {"shadow-march-thesis"};
    return {"shadow-march-thesis", {}, {}, [planted](Batch<float>& batch, const Parameters& given) {
                const auto steps = given.find("steps");
                const int n = steps == given.end() ? 128 : static_cast<int>(steps->second);
                for (int lane = 0; lane < batch.lanes; ++lane) {
                    const Shade shade = shade_of(batch, lane, n, planted);
                    batch.real(Value::shadow_visibility, lane) = shade.visibility;
                    batch.integer(Value::shadow_steps, lane) = shade.steps;
                }
            }};
}

/// A frame facing the eye over a random map, with hits of a search from straight above.
Batch<float> lit_facet(Random& random, const Map& map, float depth) {
    const Plane plane = random_plane(random);
    Batch<float> batch = facet_batch(plane, leaning(plane, random, 0.2), depth, random);
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::uv, lane, batch.vector2(Value::hit_uv, lane));
        batch.set(Value::K, lane, dvec2(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)));
        batch.integer(Value::frame_flags, lane) = 0;
    }
    batch.run("linear", {{"steps", 32}});
    random_light(random, batch.frame.lights[0]);
    batch.frame.lights[0].directional = random.chance(0.5);
    return batch;
}

testing::AssertionResult equals_loop(const Shadow& shadow, int batches) {
    for (int i = 0; i < batches; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        // Every other map in steps of 1/32 without filtering: ray and height often meet exactly.
        const bool stepped = i % 2 == 1;
        Map map = noise_map(random, 16, 16);
        if (stepped) {
            map = height_map(16, 16,
                             [&](int, int) { return static_cast<float>(random.below(33)) / 32; });
            map.sampled.sampler.mag = map.sampled.sampler.min = Filter::nearest;
        }
        Batch<float> batch = lit_facet(random, map, static_cast<float>(random.uniform(0, 0.5)));
        const int n = stepped ? 32 : 1 + random.below(64);
        shadow.run(batch, {{"steps", n}});
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const Shade expected = shade_of(batch, lane, n, Planted::none);
            if (batch.real(Value::shadow_visibility, lane) == expected.visibility &&
                batch.integer(Value::shadow_steps, lane) == expected.steps) {
                continue;
            }
            return testing::AssertionFailure() << "batch " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadowMarchThesis, EqualsTheLoop) {
    EXPECT_TRUE(equals_loop(march(), rounds(200)));
    for (const Planted planted :
         {Planted::shadow_of_the_mirror, Planted::unlit_side_visible, Planted::shadow_acne}) {
        EXPECT_FALSE(equals_loop(march(planted), 20)) << static_cast<int>(planted);
    }
}

// ---- Maps whose shadows are known ---------------------------------------------------------------

/// Every lane that faces the light sees it; every lane that does not is dark, without a step.
testing::AssertionResult nothing_shadows(const Shadow& shadow, const Map& map, float depth) {
    int lit = 0;
    for (int i = 0; i < 200; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        Batch<float> batch = lit_facet(random, map, depth);
        shadow.run(batch);
        const Shade expected = shade_of(batch, 0, 1, Planted::none);
        lit += expected.visibility == 1;
        for (int lane = 0; lane < batch.lanes; ++lane) {
            if (batch.real(Value::shadow_visibility, lane) == expected.visibility) continue;
            return testing::AssertionFailure() << "lane " << lane << ", light " << i;
        }
    }
    const bool both_sides = lit > 20 && lit < 180;
    return both_sides ? testing::AssertionSuccess() : testing::AssertionFailure() << lit << " lit";
}

TEST(ShadowMarchThesis, FlatMapsNeverShadow) {
    for (const float h : {0.0f, 0.3f, 0.5f, 0.77f, 1.0f}) {
        EXPECT_TRUE(nothing_shadows(march(), flat_map(h), 0.3f)) << h;
    }
    EXPECT_FALSE(nothing_shadows(march(Planted::shadow_acne), flat_map(0.3f), 0.3f));
    EXPECT_FALSE(nothing_shadows(march(Planted::unlit_side_visible), flat_map(0.3f), 0.3f));
}

TEST(ShadowMarchThesis, WithoutDepthNothingShadows) {
    Random random(1);
    const Map map = noise_map(random, 16, 16);
    EXPECT_TRUE(nothing_shadows(march(), map, 0));
    EXPECT_FALSE(nothing_shadows(march(), map, 0.3f));
}

/// A wall of height 1 over the texels [30, 34) of 64, on a floor of height 0; lanes on the floor
/// along u. The light stands on the side of growing u at 45 degrees: with depth 0.25 and one world
/// unit a unit of u, shadows reach 0.25.
Batch<float> walled_floor(const Map& wall, double light_x) {
    Plane plane;
    plane.origin = dvec3(0, 0, -2);
    plane.normal = dvec3(0, 0, 1);
    plane.dPdu = dvec3(1, 0, 0);
    plane.dPdv = dvec3(0, 1, 0);
    Random random(2);
    Batch<float> batch = facet_batch(plane, plane.normal, 0.25f, random, batch_lanes);
    batch.bind(TextureSlot::height, wall.sampled);
    batch.frame.lights[0].directional = 1;
    batch.frame.lights[0].position[0] = static_cast<float>(light_x);
    batch.frame.lights[0].position[1] = 0;
    batch.frame.lights[0].position[2] = 1;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.real(Value::hit_uv, lane) = (static_cast<float>(lane) + 0.5f) / batch_lanes;
        batch.real(Value::hit_s, lane) = 1;
        batch.real(Value::hit_h, lane) = 0;
    }
    return batch;
}

/// Texels from the wall's edge within which filtering blurs it.
constexpr double blur = 1.5 / 64;

testing::AssertionResult wall_shadows_one_side(const Shadow& shadow) {
    const Map wall = height_map(
        64, 4, [](int x, int) { return x >= 30 && x < 34 ? 1.0f : 0.0f; }, Wrap::clamp_to_edge);
    const double low = 30.0 / 64, high = 34.0 / 64;
    for (const double side : {1.0, -1.0}) {
        Batch<float> batch = walled_floor(wall, side);
        shadow.run(batch);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const double u = batch.real(Value::hit_uv, lane);
            const double to_wall = side > 0 ? low - u : u - high;  // towards the light
            const bool visible = batch.real(Value::shadow_visibility, lane) == 1;
            const bool dark = to_wall > blur && to_wall < 0.25 - blur;
            const bool behind = to_wall < -(high - low) - blur;
            const bool lit = behind || to_wall > 0.25 + blur;
            if ((dark && visible) || (lit && !visible)) {
                return testing::AssertionFailure() << "u " << u << ", light at " << side;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadowMarchThesis, WallsShadowTheSideAwayFromTheLight) {
    EXPECT_TRUE(wall_shadows_one_side(march()));
    EXPECT_FALSE(wall_shadows_one_side(march(Planted::shadow_of_the_mirror)));
    EXPECT_FALSE(wall_shadows_one_side({"shadow-none"}));
}

TEST(ShadowNone, EveryLightReachesEveryPoint) {
    Batch<float> batch(16);
    batch.run("shadow-none", {}, 2);
    for (int lane = 0; lane < 16; ++lane) {
        EXPECT_EQ(batch.real(Value::shadow_visibility, lane, 0, 2), 1);
        EXPECT_EQ(batch.integer(Value::shadow_steps, lane, 2), 0);
    }
}

TEST(ShadowMarchThesis, LanesWithoutFrameTakeNoSteps) {
    Random random(9);
    const Map map = flat_map(0);
    Batch<float> batch = lit_facet(random, map, 0.3f);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::no_frame);
    }
    batch.run("shadow-march-thesis");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_EQ(batch.integer(Value::shadow_steps, lane), 0);
    }
}

TEST(ShadowMarchThesis, LightsServeTheirOwnValues) {
    Random random(5);
    const Map map = noise_map(random, 16, 16);
    Batch<float> batch = lit_facet(random, map, 0.3f);
    batch.frame.light_count = 2;
    batch.frame.lights[1] = batch.frame.lights[0];
    batch.run("shadow-march-thesis", {}, 1);
    EXPECT_TRUE(batch.poisoned(Value::shadow_visibility, 0, 0, 0));
    batch.run("shadow-march-thesis", {}, 0);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_EQ(batch.real(Value::shadow_visibility, lane, 0, 0),
                  batch.real(Value::shadow_visibility, lane, 0, 1));
    }
}

// ---- The published march ------------------------------------------------------------------------

/// The published chain over a flat map; the eye's side of every face is lit or cut at 0.01.
testing::AssertionResult published_is_lit(float height, float depth) {
    Random random(6);
    const Map map = flat_map(height);
    Batch<float> batch;
    fill_quads(batch, random, 0);
    batch.material.depth = depth;
    batch.bind(TextureSlot::height, map.sampled);
    for (const char* id : {"differentiate", "frame-thesis", "linear-thesis", "displace",
                           "shadow-march-thesis@published"}) {
        batch.run(id);
    }
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const vec3<float> light(10, 10, 10);
        const double gate = dot(normalize(light - batch.vector3(Value::hit_P, lane)),
                                normalize(batch.vector3(Value::vertex_normal, lane)));
        const float visible = batch.real(Value::shadow_visibility, lane);
        if (std::abs(gate - 0.01) > 0.02 && visible != (gate > 0.01 ? 1.0f : 0.0f)) {
            return testing::AssertionFailure() << "lane " << lane << ", L.N " << gate;
        }
    }
    return testing::AssertionSuccess();
}

/// Up to depth 1 the ray stays above 1 - h. Deeper, where the ray's world depth is compared with
/// heights that are not scaled, a plane shadows itself.
TEST(ShadowMarchThesisPublished, FlatMapsShadowOnlyWhenDeep) {
    for (const float h : {0.0f, 0.25f, 0.6f, 0.9f, 1.0f}) {
        EXPECT_TRUE(published_is_lit(h, 0)) << h;
        EXPECT_TRUE(published_is_lit(h, 0.05f)) << h;
        EXPECT_TRUE(published_is_lit(h, 1)) << h;
    }
    EXPECT_FALSE(published_is_lit(0.5f, 1.5f));
}

/// The listing counts as many steps as its view march took, which are some 128: hits of other
/// searches, however deep, are no reason for more.
TEST(ShadowMarchThesisPublished, DeepHitsTakeNoMoreSteps) {
    Random random(6);
    const Map map = flat_map(0.5f);
    Batch<float> batch;
    fill_quads(batch, random, 0);
    batch.bind(TextureSlot::height, map.sampled);
    for (const char* id : {"differentiate", "frame-thesis", "linear-thesis", "displace"})
        batch.run(id);
    int marched = 0;
    for (const float depth : {0.9f, 1e6f}) {
        for (int lane = 0; lane < batch.lanes; ++lane) batch.real(Value::hit_depth, lane) = -depth;
        for (int lane = 0; lane < batch.lanes; lane += 2)
            batch.real(Value::hit_depth, lane) = depth;
        batch.run("shadow-march-thesis@published");
        for (int lane = 0; lane < batch.lanes; ++lane) {
            EXPECT_LE(batch.integer(Value::shadow_steps, lane), 256);
            marched += batch.integer(Value::shadow_steps, lane) > 0;
        }
    }
    EXPECT_GT(marched, 0);
}

}  // namespace
}  // namespace quadrel::test
