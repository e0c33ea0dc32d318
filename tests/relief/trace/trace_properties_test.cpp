// What every offset and march promises where the answer is known, on float and on double: rows of
// trace_rows.hpp without depth, straight down, over flat maps, planes, and with one crossing.
#include "relief/trace/trace_property.hpp"

namespace quadrel::test {
namespace {

template <class T>
class TraceProperties : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(TraceProperties, ScalarTypes);

// ---- No depth, no shift; straight down ----------------------------------------------------------

template <class T>
testing::AssertionResult without_depth_nothing_moves(const TraceRow& row, const Trace<T>& trace) {
    Random random(1);
    const Map map = noise_map(random, 16, 16);
    Batch<T> batch(64);
    fill_surface(batch, random);
    batch.material.depth = 0;
    batch.material.seat = 0.75f;
    for (int lane = 0; lane < batch.lanes; ++lane) batch.set(Value::K, lane, dvec2(0));
    batch.bind(TextureSlot::height, map.sampled);
    run_baked(trace, batch, row.parameters);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (batch.vector2(Value::hit_uv, lane) == batch.vector2(Value::uv, lane) &&
            batch.real(Value::hit_depth, lane) == 0) {
            continue;
        }
        return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceProperties, WithoutDepthNothingMoves) {
    using enum TraceKind;
    holds_for_all<TypeParam>(without_depth_nothing_moves, {offset, march, refined});
    notices<TypeParam>(without_depth_nothing_moves, Planted::off_the_ray, {offset, march, refined});
}

/// Whether s is what the row promises where the ray meets a surface of height h.
template <class T>
bool is_hit_of(const TraceRow& row, double s, T h) {
    const T exact = T(1) - h;
    if (row.kind == TraceKind::offset) return s == exact;
    if (row.kind == TraceKind::refined) {
        return s >= exact - row.early - 1e-6 && s <= exact + row.late + 1e-6;
    }
    // The first k with k / n at or behind it.
    const T n = static_cast<T>(row.lattice);
    const double k = std::round(s * row.lattice);
    const auto below = [&](double i) { return h >= T(1) - static_cast<T>(i) / n; };
    return s == static_cast<T>(k) / n && below(k) && (k == 0 || !below(k - 1));
}

template <class T>
testing::AssertionResult each_lane_hits(const TraceRow& row, Batch<T>& batch,
                                        const std::function<T(int)>& height) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const T s = batch.real(Value::hit_s, lane), h = height(lane);
        // The march of height-outward does not test the bottom plane.
        const bool unknown = row.id == "height-outward" && s == 1;
        const bool status = unknown || status_of(batch, lane) == Status::hit;
        if (status && is_hit_of<T>(row, s, h)) continue;
        return testing::AssertionFailure() << "lane " << lane << ": s " << s << " for height " << h
                                           << ", status " << batch.integer(Value::hit_status, lane);
    }
    return testing::AssertionSuccess();
}

/// K = 0: the height is the same all along the ray.
template <class T>
testing::AssertionResult straight_down(const TraceRow& row, const Trace<T>& trace) {
    for (int i = 0; i < 12; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Map map =
            noise_map(random, 1 + random.below(9), 1 + random.below(9), static_cast<Wrap>(i % 5));
        Batch<T> batch(64);
        fill_surface(batch, random);
        look_straight_down(batch);
        batch.bind(TextureSlot::height, map.sampled);
        run_baked(trace, batch, row.parameters);
        const FastHeight<Quad<T>> heights(map.sampled);
        const auto result = each_lane_hits<T>(row, batch, [&](int lane) {
            const auto uv = batch.vector2(Value::uv, lane);
            return heights({}, vec2<Quad<T>>(Quad<T>(uv.x), Quad<T>(uv.y))).lane[0];
        });
        if (!result) return testing::AssertionFailure() << result.message() << ", map " << i;
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceProperties, StraightDownTheHeightIsTheHit) {
    using enum TraceKind;
    holds_for_all<TypeParam>(straight_down, {offset, march, refined});
    notices<TypeParam>(straight_down, Planted::one_sample_late, {offset, march});
    notices<TypeParam>(straight_down, Planted::surface_not_reached, {offset, march, refined});
}

/// Height m / 64 everywhere: every ray meets it at s = 1 - m / 64.
template <class T>
testing::AssertionResult flat_maps(const TraceRow& row, const Trace<T>& trace) {
    for (int m = 0; m <= 64; m += 4) {
        Random random(static_cast<std::uint64_t>(m));
        const Map map = flat_map(static_cast<float>(m) / 64, 1 + m % 5);
        Batch<T> batch(64);
        fill_surface(batch, random, {0.2});
        // The number of steps that `steep` takes straight down; the sphere needs the ray's own r.
        for (int lane = 0; lane < batch.lanes; ++lane) {
            if (row.kind == TraceKind::march) batch.real(Value::r, lane) = 1;
            if (row.id == "steep-constant-xy") batch.set(Value::K, lane, dvec2(0.1, 0.0625));
        }
        batch.material.seat = static_cast<float>(m % 3) / 2;
        batch.bind(TextureSlot::height, map.sampled);
        run_baked(trace, batch, row.parameters);
        const auto result =
            each_lane_hits<T>(row, batch, [&](int) { return static_cast<T>(m) / 64; });
        if (!result) return testing::AssertionFailure() << result.message();
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceProperties, FlatMapsAreHitAtTheirDepth) {
    using enum TraceKind;
    holds_for_all<TypeParam>(flat_maps, {offset, march, refined});
    notices<TypeParam>(flat_maps, Planted::one_sample_late, {offset, march});
    notices<TypeParam>(flat_maps, Planted::surface_not_reached, {offset, march, refined});
}

// ---- One crossing -------------------------------------------------------------------------------

template <class T>
testing::AssertionResult finds_the_one_crossing(const TraceRow& row, const Trace<T>& trace) {
    static const GentleInputs<T> inputs;
    Batch<T> batch = inputs.batch;
    run_baked(trace, batch, row.parameters);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const double late =
            batch.real(Value::hit_s, lane) - inputs.hits[static_cast<std::size_t>(lane)];
        const double judge = 1.0 / brute_steps + 1e-6;
        const bool found = status_of(batch, lane) == Status::hit;
        if (found && late >= -row.early - judge && late <= row.late + 1e-6) continue;
        return testing::AssertionFailure() << late << " late in lane " << lane;
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceProperties, FindTheOneCrossingAsCloseAsTheyPromise) {
    using enum TraceKind;
    holds_for_all<TypeParam>(finds_the_one_crossing, {march, refined});
    notices<TypeParam>(finds_the_one_crossing, Planted::one_sample_late, {march, refined});
    notices<TypeParam>(finds_the_one_crossing, Planted::one_sample_early, {march, refined});
}

/// Heights a + b x + c y around (0.5, 0.5): F is linear along every ray.
template <class T>
testing::AssertionResult planes_are_exact(const TraceRow& row, const Trace<T>& trace) {
    const double tolerance = std::same_as<T, float> ? 2e-6 : 1e-13;
    for (int i = 0; i < 8; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const int b = random.below(33) - 16, c = random.below(33) - 16;
        const Map map = height_map(
            64, 64, [&](int x, int y) { return 0.5f + float(b * (x - 32) + c * (y - 32)) / 2048; },
            Wrap::clamp_to_edge);
        Batch<T> batch(64);
        fill_surface(batch, random, {0.6, 0.15});
        batch.bind(TextureSlot::height, map.sampled);
        for (int lane = 0; lane < batch.lanes; ++lane) batch.set(Value::uv, lane, dvec2(0.5, 0.5));
        run_baked(trace, batch, row.parameters);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const auto K = batch.vector2(Value::K, lane);
            // Texel x has its centre at u = (x + 1/2) / 64.
            const double at_start = 0.5 - 0.5 * (b + c) / 2048.0;
            const double slope = (b * double(K.x) + c * double(K.y)) * 64 / 2048;
            const double exact = (1 - at_start) / (1 + slope);
            const double error = std::abs(double(batch.real(Value::hit_s, lane)) - exact);
            if (error <= tolerance) continue;
            return testing::AssertionFailure() << error << " off in lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceProperties, ChordsAreExactOnPlanes) {
    for (const TraceRow& row : trace_rows()) {
        if (!row.exact_on_planes) continue;
        EXPECT_TRUE((planes_are_exact<TypeParam>(row, {row.id}))) << name_of(row);
        EXPECT_FALSE(
            (planes_are_exact<TypeParam>(row, flawed<TypeParam>(row, Planted::half_a_step_late))));
    }
    EXPECT_FALSE((planes_are_exact<TypeParam>({"linear", TraceKind::march, {}}, {"linear"})));
}

}  // namespace
}  // namespace quadrel::test
