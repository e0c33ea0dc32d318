// The unlit colour map, and what the published lighting does where its listing surprises. (That it
// is the listing's, bit for bit, is tested with the relief stages.)
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

testing::AssertionResult shows(Batch<float>& batch, const vec3<float>& color, float opacity) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (batch.vector3(Value::color, lane) == color &&
            batch.real(Value::opacity, lane) == opacity) {
            continue;
        }
        return testing::AssertionFailure() << "lane " << lane << " is not of that colour";
    }
    return testing::AssertionSuccess();
}

TEST(ShadeTexture, ShowsTheColourMap) {
    Random random(1);
    Batch<float> batch = random_points(random, 2);
    const vec4<float> texel(0.25f, 0.5f, 0.75f, 0.125f);
    const Map map = constant_map(texel);
    batch.run("shade-texture");
    EXPECT_TRUE(shows(batch, vec3<float>(1), 1));  // no map: white
    batch.bind(TextureSlot::color, map.sampled);
    batch.run("shade-texture");
    EXPECT_TRUE(shows(batch, vec3<float>(texel), texel.a));
    EXPECT_FALSE(shows(batch, vec3<float>(texel), 1));
}

/// Where hit_uv jumps, the footprint is still that of the undisplaced UV: level 0.
TEST(ShadeTexture, KeepsTheUndisplacedFootprint) {
    Random random(2);
    Batch<float> batch = random_points(random, 0);
    SamplerState nearest;
    nearest.mag = nearest.min = Filter::nearest;
    nearest.mip = MipFilter::nearest;
    const Map map = make_map(
        64, 64, 4, [](int x, int y, int) { return (x + y) % 2 == 0 ? 1.0f : 0.0f; }, nearest);
    batch.bind(TextureSlot::color, map.sampled);
    batch.run("shade-texture");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const float c = batch.real(Value::color, lane);
        EXPECT_TRUE(c == 0 || c == 1) << c;  // every coarser level is 1/2 throughout
    }
}

TEST(ShadeThesisPublished, SeesTheFirstLightAlone) {
    Random random(3);
    Batch<float> both = random_points(random, 2), first = both;
    first.frame.light_count = 1;
    both.run("shade-thesis@published");
    first.run("shade-thesis@published");
    constexpr auto color = values(Value::color, Value::light_diffuse, Value::light_specular);
    EXPECT_TRUE(same_bits<float>(both, first, color));
}

/// Without lights nothing wrote their visibilities, and nothing reads them.
TEST(ShadeThesisPublished, NoLightIsDark) {
    Random random(5);
    Batch<float> batch = random_points(random, 0);
    batch.poison(Value::shadow_visibility);
    const Map map = constant_map({1, 1, 1, 1});
    batch.bind(TextureSlot::color, map.sampled);
    batch.run("shade-thesis@published");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_EQ(batch.vector3(Value::light_diffuse, lane), vec3<float>(0));
        EXPECT_EQ(batch.vector3(Value::light_specular, lane), vec3<float>(0));
    }
}

/// Diffuse light is negative on the far side: the listing does not clamp it.
TEST(ShadeThesisPublished, DiffuseIsNotClamped) {
    Random random(4);
    Batch<float> batch = random_points(random, 1);
    const Map map = constant_map({1, 1, 1, 1});
    batch.bind(TextureSlot::color, map.sampled);
    batch.run("shade-thesis@published");
    int negative = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        negative += batch.real(Value::light_diffuse, lane) < 0;
    }
    EXPECT_GT(negative, 0);
}

/// Without lights nothing of them is read, and the ambient term alone remains.
TEST(PublishedShadings, NoLightLeavesTheAmbientTerm) {
    for (const char* id : {"shade-welsh@published", "shade-mcguire@published",
                           "shade-rabbid@published", "shade-gg3"}) {
        Random random(3);
        Batch<float> batch = random_points(random, 0);
        batch.poison(Value::shadow_visibility);
        open_sky(batch);
        Batch<float> dim = batch;
        for (int lane = 0; lane < dim.lanes; ++lane) dim.real(Value::occlusion, lane) = 0.5f;
        batch.run(id);
        dim.run(id);
        for (int lane = 0; lane < batch.lanes; ++lane)
            EXPECT_EQ(dim.vector3(Value::color, lane), batch.vector3(Value::color, lane) * 0.5f)
                << id;
    }
}

}  // namespace
}  // namespace quadrel::test
