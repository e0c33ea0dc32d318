// What holds for every offset and march over any map, on float and on double: results that agree
// with each other, hits at or below the surface, broken maps, mirrored ones.
#include "effort.hpp"
#include "relief/trace/trace_property.hpp"

namespace quadrel::test {
namespace {

template <class T>
class TraceOnAnyMap : public testing::Test {};
using ScalarTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(TraceOnAnyMap, ScalarTypes);

/// 1 x 1 to 9 x 9 texels, every wrap mode, any seat, rough heights.
template <class T>
struct RoughInputs {
    Random random;
    Map map;
    Batch<T> batch;

    explicit RoughInputs(int seed) : random(static_cast<std::uint64_t>(seed)), batch(64) {
        map = noise_map(random, 1 + random.below(9), 1 + random.below(9),
                        static_cast<Wrap>(random.below(5)));
        fill_surface(batch, random, {0.05});
        batch.material.seat = static_cast<float>(random.below(5)) / 4;
        batch.bind(TextureSlot::height, map.sampled);
    }
};

template <class T>
testing::AssertionResult lane_is_consistent(const TraceRow& row, Batch<T>& b, int lane) {
    const T s = b.real(Value::hit_s, lane), along = s - (T(1) - T(b.material.seat));
    const auto uv = b.vector2(Value::uv, lane) + b.vector2(Value::K, lane) * along;
    const Status status = status_of(b, lane);
    const bool ended =
        status == Status::hit || status == Status::floor || (status == Status::cap && row.may_cap);
    if (!ended) return testing::AssertionFailure() << "status of lane " << lane;
    if (!(s >= 0 && s <= 1)) return testing::AssertionFailure() << "s " << s;
    if (b.real(Value::hit_depth, lane) != along * b.real(Value::relief_depth, lane)) {
        return testing::AssertionFailure() << "depth of lane " << lane;
    }
    if (b.vector2(Value::hit_uv, lane) != uv) {
        return testing::AssertionFailure() << "uv of lane " << lane;
    }
    return testing::AssertionSuccess();
}

/// The results agree with each other, and the fetches with the sampler's count.
template <class T>
testing::AssertionResult results_agree(const TraceRow& row, const Trace<T>& trace) {
    for (int i = 0; i < rounds(25); ++i) {
        RoughInputs<T> inputs(i);
        Batch<T>& batch = inputs.batch;
        run_baked(trace, batch, row.parameters);
        std::uint64_t fetches = 0;
        for (int lane = 0; lane < batch.lanes; ++lane) {
            const auto result = row.kind == TraceKind::offset
                                    ? testing::AssertionSuccess()
                                    : lane_is_consistent(row, batch, lane);
            if (!result) return testing::AssertionFailure() << result.message() << ", map " << i;
            fetches += static_cast<std::uint64_t>(batch.integer(Value::hit_fetches, lane));
        }
        if (fetches != batch.fetches()) return testing::AssertionFailure() << "fetches, map " << i;
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceOnAnyMap, ResultsAgreeOnAnyMap) {
    using enum TraceKind;
    holds_for_all<TypeParam>(results_agree, {offset, march, refined});
    notices<TypeParam>(results_agree, Planted::off_the_ray, {march, refined});
    notices<TypeParam>(results_agree, Planted::fetch_not_counted, {offset, march, refined});
}

/// The bilinear height at a hit, in double, without the ray's own: F.
template <class T>
double excess(Batch<T>& batch, int lane) {
    const double s = batch.real(Value::hit_s, lane);
    const auto uv = dvec2(batch.vector2(Value::uv, lane)) +
                    dvec2(batch.vector2(Value::K, lane)) * (s - (1 - double(batch.material.seat)));
    const FastHeight<Quad<double>> heights(*batch.bound(TextureSlot::height));
    return heights({}, vec2<Quad<double>>(Quad<double>(uv.x), Quad<double>(uv.y))).lane[0] -
           (1 - s);
}

/// A hit is at or below the surface, whatever the map.
template <class T>
testing::AssertionResult hits_are_below(const TraceRow& row, const Trace<T>& trace) {
    for (int i = 0; i < rounds(25); ++i) {
        RoughInputs<T> inputs(i);
        run_baked(trace, inputs.batch, row.parameters);
        for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
            const double F = excess(inputs.batch, lane);
            if (status_of(inputs.batch, lane) != Status::hit || F >= -row.gap - 2e-5) continue;
            return testing::AssertionFailure() << F << " in lane " << lane << ", map " << i;
        }
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceOnAnyMap, HitsAreNeverAboveTheSurface) {
    for (const TraceRow& row : trace_rows()) {
        if (row.kind == TraceKind::offset || !row.ends_below) continue;
        EXPECT_TRUE(hits_are_below<TypeParam>(row, {row.id})) << name_of(row);
        EXPECT_FALSE(
            hits_are_below<TypeParam>(row, flawed<TypeParam>(row, Planted::surface_not_reached)));
    }
}

/// NaN everywhere: NAN, and for searches the bottom plane with numbers everywhere.
template <class T>
testing::AssertionResult nan_is_reported(const TraceRow& row, const Trace<T>& trace) {
    const Map map = flat_map(std::numeric_limits<float>::quiet_NaN());
    Random random(4);
    Batch<T> batch(64);
    fill_surface(batch, random);
    batch.bind(TextureSlot::height, map.sampled);
    run_baked(trace, batch, row.parameters);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (status_of(batch, lane) != Status::nan) return testing::AssertionFailure() << lane;
        const auto uv = batch.vector2(Value::hit_uv, lane);
        const bool numbers = uv.x == uv.x && uv.y == uv.y && batch.real(Value::hit_s, lane) <= 1;
        if (row.kind != TraceKind::offset && !numbers) {
            return testing::AssertionFailure() << "no number in lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceOnAnyMap, NanIsReported) {
    for (const TraceRow& row : trace_rows()) {
        if (!row.takes_nan) continue;
        EXPECT_TRUE((nan_is_reported<TypeParam>(row, {row.id}))) << name_of(row);
        EXPECT_FALSE(
            (nan_is_reported<TypeParam>(row, flawed<TypeParam>(row, Planted::nan_is_floor))));
    }
}

/// Texels of minus infinity, a number and infinity, unfiltered: where a ray meets them between two
/// points, the search gives a number.
template <class T>
testing::AssertionResult infinities_leave_numbers(const TraceRow& row, const Trace<T>& trace) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    SamplerState nearest = plain_sampler();
    nearest.mag = nearest.min = Filter::nearest;
    int hits = 0;
    for (int i = 0; i < rounds(10); ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Map map = make_map(
            8, 8, 1,
            [&](int, int, int) {
                const float heights[3] = {-infinity, 0.5f, infinity};
                return heights[random.below(3)];
            },
            nearest);
        Batch<T> batch(64);
        fill_surface(batch, random);
        batch.bind(TextureSlot::height, map.sampled);
        trace.run(batch, row.parameters);
        for (int lane = 0; lane < batch.lanes; ++lane) {
            if (status_of(batch, lane) != Status::hit) continue;
            ++hits;
            const T s = batch.real(Value::hit_s, lane);
            if (!(s >= 0 && s <= 1))
                return testing::AssertionFailure() << "s " << s << ", map " << i;
        }
    }
    return hits > 0 ? testing::AssertionSuccess() : testing::AssertionFailure() << "no hits";
}

/// Marches that read the height map alone, by its sampler.
bool reads_points_of_heights(const TraceRow& row) {
    return row.kind != TraceKind::offset && row.by_points &&
           std::ranges::all_of(find_stage(row.id)->textures,
                               [](TextureSlot slot) { return slot == TextureSlot::height; });
}

TYPED_TEST(TraceOnAnyMap, InfiniteHeightsLeaveNumbers) {
    for (const TraceRow& row : trace_rows()) {
        if (!reads_points_of_heights(row)) continue;
        EXPECT_TRUE((infinities_leave_numbers<TypeParam>(row, {row.id}))) << name_of(row);
        EXPECT_FALSE((
            infinities_leave_numbers<TypeParam>(row, flawed<TypeParam>(row, Planted::hit_at_nan))));
    }
}

/// Map and rays reflected in u: so is the result. Not to the bit: weights are 1 - t for t.
template <class T>
testing::AssertionResult mirrored(const TraceRow& row, const Trace<T>& trace) {
    int differ = 0;
    for (int i = 0; i < 10; ++i) {
        Random random(static_cast<std::uint64_t>(i)), again = random;
        const auto texels = [](Random& of, bool reflected) {
            std::array<float, 64> h;
            for (float& x : h) x = static_cast<float>(of.below(257)) / 256;
            return height_map(8, 8, [=](int x, int y) {
                return h[static_cast<std::size_t>(8 * y + (reflected ? 7 - x : x))];
            });
        };
        const Map map = texels(random, false), image = texels(again, true);
        Batch<T> one(64);
        fill_surface(one, random);
        Batch<T> other = one;
        one.bind(TextureSlot::height, map.sampled);
        other.bind(TextureSlot::height, image.sampled);
        for (int lane = 0; lane < one.lanes; ++lane) {
            other.real(Value::uv, lane) = 1 - one.real(Value::uv, lane);
            other.real(Value::K, lane) = -one.real(Value::K, lane);
            for (int c = 0; c < 3; ++c) {
                other.real(Value::J, lane, c) = -one.real(Value::J, lane, c);
                other.real(Value::T, lane, c) = -one.real(Value::T, lane, c);
            }
        }
        run_baked({row.id}, one, row.parameters);
        run_baked(trace, other, row.parameters);
        for (int lane = 0; lane < one.lanes; ++lane) {
            const double du = 1 - other.real(Value::hit_uv, lane) - one.real(Value::hit_uv, lane);
            const double ds = other.real(Value::hit_s, lane) - one.real(Value::hit_s, lane);
            differ += std::abs(du) > 1e-4 || std::abs(ds) > 1e-4;
        }
    }
    // Decisions may turn over where a ray grazes the surface.
    return differ <= 6 ? testing::AssertionSuccess()
                       : testing::AssertionFailure() << differ << " of 640 lanes";
}

TYPED_TEST(TraceOnAnyMap, MirroredMapsMirrorTheResult) {
    using enum TraceKind;
    holds_for_all<TypeParam>(mirrored, {offset, march, refined});
    notices<TypeParam>(mirrored, Planted::half_a_step_late, {march, refined});
}

}  // namespace
}  // namespace quadrel::test
