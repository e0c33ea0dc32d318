// What the published search does where its listing surprises. (That it is the listing's, bit for
// bit, is tested in published_test.cpp.)
#include "relief/march/linear_search.hpp"

namespace quadrel::test {
namespace {

/// At depth 0 the first test is 0 > 0, the second 1/128 > 0: every ray moves exactly one step.
TEST(LinearThesis, MovesOneStepAtDepthZero) {
    Random random(15);
    const Map map = noise_map(random, 16, 16);
    Batch<float> batch;
    fill_rays(batch, random);
    batch.material.depth = 0;
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::uv_rate, lane, batch.vector2(Value::K, lane));
    }
    batch.run("linear-thesis");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const auto moved =
            batch.vector2(Value::uv, lane) + batch.vector2(Value::K, lane) * (1.0f / 128);
        EXPECT_EQ(batch.vector2(Value::hit_uv, lane), moved);
        EXPECT_EQ(batch.real(Value::hit_depth, lane), 1.0f / 128);
        EXPECT_EQ(batch.integer(Value::hit_steps, lane), 2);
    }
}

/// hit.s is in units of the depth; hit.h the height of the last test, in every lane of a quad.
TEST(LinearThesis, ReportsTheLastTest) {
    Random random(17);
    const Map map = noise_map(random, 16, 16);
    Batch<float> batch(64);
    fill_rays(batch, random);
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::uv_rate, lane, batch.vector2(Value::K, lane));
    }
    batch.run("linear-thesis");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const float depth = batch.real(Value::hit_depth, lane);
        EXPECT_EQ(batch.real(Value::hit_s, lane), depth / batch.material.depth);
        EXPECT_EQ(batch.real(Value::hit_h, lane),
                  height_at(batch, lane, batch.vector2(Value::hit_uv, lane)));
    }
}

/// Deeper than one world unit the march ends above the floor, at 129/128.
TEST(LinearThesis, EndsBehindOneWorldUnit) {
    Random random(16);
    const Map map = flat_map(0);
    Batch<float> batch(16);
    fill_rays(batch, random);
    batch.material.depth = 2;
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < 16; ++lane) batch.set(Value::uv_rate, lane, dvec2(0.1, 0.2));
    batch.run("linear-thesis");
    EXPECT_EQ(batch.real(Value::hit_depth, 0), 129.0f / 128);
    EXPECT_EQ(batch.integer(Value::hit_steps, 0), 129);
    EXPECT_EQ(batch.integer(Value::hit_status, 0), static_cast<int>(Status::floor));
}

}  // namespace
}  // namespace quadrel::test
