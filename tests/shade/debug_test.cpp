// shade-debug shows the values that it says.
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

enum View { s, uv, K, N, status, depth };

Batch<float> random_hits() {
    Random random(1);
    Batch<float> batch = random_points(random, 1);
    batch.own_depth = true;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.real(Value::hit_s, lane) = static_cast<float>(random.uniform(0, 1));
        batch.real(Value::hit_depth, lane) = static_cast<float>(random.uniform(-0.1, 0.2));
        batch.real(Value::relief_depth, lane) = lane % 8 == 0 ? 0 : 0.25f;
        batch.set(Value::hit_uv, lane, dvec2(random.uniform(-3, 3), random.uniform(-3, 3)));
        batch.set(Value::K, lane, dvec2(random.uniform(-1, 1), random.uniform(-1, 1)));
        batch.set(Value::frame_normal, lane, random_direction(random));
        batch.set(Value::vertex_normal, lane, random_direction(random) * 1.5);
        batch.integer(Value::hit_status, lane) = lane % 8;
    }
    return batch;
}

/// What a view shows of a lane.
dvec3 expected(Batch<float>& batch, int lane, View view) {
    const dvec2 shift(batch.vector2(Value::K, lane)), at(batch.vector2(Value::hit_uv, lane));
    const double size = length(shift), D = batch.real(Value::relief_depth, lane);
    // NONE HIT FLOOR CAP CLIP NOFRAME NAN OUTSIDE
    const dvec3 colors[] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                            {0, 1, 1}, {1, 0, 0}, {1, 0, 1}, {1, 1, 1}};
    switch (view) {
        case s:
            return dvec3(batch.real(Value::hit_s, lane));
        case uv:
            return {at.x - std::floor(at.x), at.y - std::floor(at.y), 0};
        case K:
            return {0.5 + 0.5 * shift.x / (size + 0.0005), 0.5 + 0.5 * shift.y / (size + 0.0005),
                    size / 0.5};
        case N:
            return dvec3(batch.vector3(Value::N, lane)) * 0.5 + 0.5;
        case status:
            return colors[batch.integer(Value::hit_status, lane)];
        case depth:
            break;
    }
    if (D == 0) return dvec3(0.0);
    // SP - P of the listing, by its own rays: SSR = -E / (N.E), SR = SSR + N (-N.SSR).
    const dvec3 n(batch.vector3(Value::frame_normal, lane)), E = normalize(n + dvec3(0.2, 0.1, 0));
    const dvec3 SSR = -E / dot(n, E), SR = SSR + n * dot(-n, SSR);
    const double offset = batch.real(Value::hit_depth, lane);
    return {dot((SR - SSR) * offset, dvec3(batch.vector3(Value::vertex_normal, lane))) / D, 0, 0};
}

testing::AssertionResult shows(View view, View asked) {
    Batch<float> batch = random_hits();
    batch.run("shade-debug", {{"view", asked}, {"gain", 0.5}});
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const dvec3 error = dvec3(batch.vector3(Value::color, lane)) - expected(batch, lane, view);
        if (!(length(error) < 1e-5) || batch.real(Value::opacity, lane) != 1)
            return testing::AssertionFailure() << "view " << view << ", lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(ShadeDebug, ShowsWhatItSays) {
    for (int view = s; view <= depth; ++view) {
        EXPECT_TRUE(shows(View(view), View(view)));
        EXPECT_FALSE(shows(View(view), View((view + 1) % 6)));
    }
}

}  // namespace
}  // namespace quadrel::test
