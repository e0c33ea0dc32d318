// What holds for every offset and march, on float and on double: rows of trace_rows.hpp against
// what their kind promises.
#include "relief/trace_rows.hpp"

namespace quadrel::test {
namespace {

template <class T>
using Trace = StageUnderTest<T>;

template <class T>
Status status_of(Batch<T>& batch, int lane) {
    return static_cast<Status>(batch.integer(Value::hit_status, lane));
}

/// Moves every lane's result by ds along its ray.
template <class T>
void move_hit(Batch<T>& batch, double ds) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        T& s = batch.real(Value::hit_s, lane);
        s += static_cast<T>(ds);
        const T along = s - (T(1) - T(batch.material.seat));
        batch.set(Value::hit_uv, lane,
                  batch.vector2(Value::uv, lane) + batch.vector2(Value::K, lane) * along);
        batch.real(Value::hit_depth, lane) = along * batch.real(Value::relief_depth, lane);
    }
}

/// The row with an error behind it.
template <class T>
Trace<T> flawed(const TraceRow& row, Planted planted) {
    const double step = 1.0 / std::max(row.lattice, 1);
    return {row.id, {}, [planted, step](Batch<T>& b) {
                if (planted == Planted::one_sample_late) move_hit(b, step);
                if (planted == Planted::one_sample_early) move_hit(b, -step);
                if (planted == Planted::half_a_step_late) move_hit(b, step / 2);
                if (planted == Planted::surface_not_reached) move_hit(b, -0.2);
                if (planted == Planted::off_the_ray) b.real(Value::hit_uv, 3, 1) += T(1e-5);
                if (planted == Planted::fetch_not_counted) b.integer(Value::hit_fetches, 5) -= 1;
                if (planted == Planted::nan_is_floor) {
                    b.integer(Value::hit_status, 7) = static_cast<int>(Status::floor);
                }
            }};
}

/// A property: how an implementation of a row fails it, or success.
template <class T>
using Property = testing::AssertionResult (*)(const TraceRow&, const Trace<T>&);

template <class T>
void holds_for_all(Property<T> property, std::initializer_list<TraceKind> kinds) {
    for (const TraceRow& row : trace_rows()) {
        if (std::find(kinds.begin(), kinds.end(), row.kind) == kinds.end()) continue;
        EXPECT_TRUE(property(row, {row.id})) << name_of(row);
    }
}
/// Of all those rows.
template <class T>
void notices(Property<T> property, Planted planted, std::initializer_list<TraceKind> kinds) {
    for (const TraceRow& row : trace_rows()) {
        if (std::find(kinds.begin(), kinds.end(), row.kind) == kinds.end()) continue;
        EXPECT_FALSE(property(row, flawed<T>(row, planted)))
            << name_of(row) << ", " << static_cast<int>(planted);
    }
}

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
    trace.run(batch, row.parameters);
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
        trace.run(batch, row.parameters);
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
        trace.run(batch, row.parameters);
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

/// Of all rays of |K| < 1.4: slopes of 0.7 at most, curved by the wave's corners.
Map gentle_map() {
    return height_map(32, 32, [](int x, int y) {
        return static_cast<float>(std::abs(x - 16) + std::abs(y - 16)) / 64 + 0.25f;
    });
}

constexpr int brute_steps = 20000;

/// s of the first of 20001 samples at or below the surface, in double.
template <class T>
std::vector<double> brute_hits(Batch<T>& rays) {
    Batch<double> batch(rays.lanes);
    for (int lane = 0; lane < rays.lanes; ++lane) {
        for (const Value v : {Value::uv, Value::K, Value::dUVdx, Value::dUVdy}) {
            batch.set(v, lane, rays.vector2(v, lane));
        }
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.integer(Value::frame_flags, lane) = 0;
    }
    batch.material = rays.material;
    batch.bind(TextureSlot::height, *rays.bound(TextureSlot::height));
    batch.run("linear", {{"steps", brute_steps}});
    std::vector<double> hits;
    for (int lane = 0; lane < rays.lanes; ++lane) hits.push_back(batch.real(Value::hit_s, lane));
    return hits;
}

/// Rays over the gentle map, and where they cross it.
template <class T>
struct GentleInputs {
    Map map = gentle_map();
    Batch<T> batch{64};
    std::vector<double> hits;

    GentleInputs() {
        Random random(6);
        fill_surface(batch, random, {0.3});
        batch.bind(TextureSlot::height, map.sampled);
        hits = brute_hits(batch);
    }
};

template <class T>
testing::AssertionResult finds_the_one_crossing(const TraceRow& row, const Trace<T>& trace) {
    static const GentleInputs<T> inputs;
    Batch<T> batch = inputs.batch;
    trace.run(batch, row.parameters);
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
        trace.run(batch, row.parameters);
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

// ---- Any map ------------------------------------------------------------------------------------

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
    const bool ended = status == Status::hit || status == Status::floor ||
                       (status == Status::cap && row.id == "thesis-sphere");
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
    for (int i = 0; i < 25; ++i) {
        RoughInputs<T> inputs(i);
        Batch<T>& batch = inputs.batch;
        trace.run(batch, row.parameters);
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

TYPED_TEST(TraceProperties, ResultsAgreeOnAnyMap) {
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
    for (int i = 0; i < 25; ++i) {
        RoughInputs<T> inputs(i);
        trace.run(inputs.batch, row.parameters);
        for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
            const double tolerance = row.id == "thesis-sphere" ? 1.0 / 256 : 0;
            const double F = excess(inputs.batch, lane);
            if (status_of(inputs.batch, lane) != Status::hit || F >= -tolerance - 2e-5) continue;
            return testing::AssertionFailure() << F << " in lane " << lane << ", map " << i;
        }
    }
    return testing::AssertionSuccess();
}

TYPED_TEST(TraceProperties, HitsAreNeverAboveTheSurface) {
    for (const TraceRow& row : trace_rows()) {
        if (row.kind == TraceKind::offset || !row.ends_below) continue;
        EXPECT_TRUE(hits_are_below<TypeParam>(row, {row.id})) << name_of(row);
        EXPECT_FALSE(
            hits_are_below<TypeParam>(row, flawed<TypeParam>(row, Planted::surface_not_reached)));
    }
}

/// What a march tested.
struct Visits : StageLog {
    std::vector<MarchStep> steps;
    void march_step(const MarchStep& step) override { steps.push_back(step); }
    void fetch(const FetchEvent&) override {}
};

/// No sample before the first crossing is below the surface: neither a dense march nor any point
/// that a row tested. What a row reports is what it tested, lane by lane.
testing::AssertionResult no_visit_below_before(const TraceRow& row, double shift) {
    static const GentleInputs<float> inputs;
    for (int quad = 0; quad < 16; ++quad) {
        Batch<float> batch = inputs.batch;
        for (int lane = 0; lane < batch.lanes; ++lane) batch.active[lane] = lane / 4 == quad;
        Visits visits;
        batch.log = &visits;
        batch.run(row.id, row.parameters);
        for (int i = 0; i < 4; ++i) {
            const auto first = inputs.hits[static_cast<std::size_t>(4 * quad + i)] + shift;
            int tested = 0;
            for (const MarchStep& step : visits.steps) {
                tested += step.active.lane[i];
                const bool below = step.map_height.lane[i] >= step.ray_height.lane[i];
                const bool before = step.s.lane[i] < first - 1.0 / brute_steps - 1e-6;
                if (!step.active.lane[i] || !below || !before) continue;
                return testing::AssertionFailure() << "at " << step.s.lane[i] << ", not " << first;
            }
            if (tested == batch.integer(Value::hit_steps, 4 * quad + i)) continue;
            return testing::AssertionFailure() << tested << " visits";
        }
    }
    return testing::AssertionSuccess();
}

TEST(TraceVisits, NoSampleBeforeTheCrossingIsBelow) {
    for (const TraceRow& row : trace_rows()) {
        if (row.kind == TraceKind::offset) continue;
        EXPECT_TRUE(no_visit_below_before(row, 0)) << name_of(row);
        // A crossing that is said to be later than it is; the sphere's steps stay above it.
        if (row.id == "thesis-sphere") continue;
        EXPECT_FALSE(no_visit_below_before(row, 0.15)) << name_of(row);
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
    trace.run(batch, row.parameters);
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

TYPED_TEST(TraceProperties, NanIsReported) {
    using enum TraceKind;
    holds_for_all<TypeParam>(nan_is_reported, {offset, march, refined});
    notices<TypeParam>(nan_is_reported, Planted::nan_is_floor, {offset, march, refined});
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
        one.run(row.id, row.parameters);
        trace.run(other, row.parameters);
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

TYPED_TEST(TraceProperties, MirroredMapsMirrorTheResult) {
    using enum TraceKind;
    holds_for_all<TypeParam>(mirrored, {offset, march, refined});
    notices<TypeParam>(mirrored, Planted::half_a_step_late, {march, refined});
}

}  // namespace
}  // namespace quadrel::test
