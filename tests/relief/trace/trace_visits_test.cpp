// What marches test on their way, as a probe sees it.
#include "relief/trace/trace_property.hpp"

namespace quadrel::test {
namespace {

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
        run_baked({row.id}, batch, row.parameters);
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
        if (row.kind == TraceKind::offset || !row.by_points) continue;
        EXPECT_TRUE(no_visit_below_before(row, 0)) << name_of(row);
        // A crossing that is said to be later than it is; safe steps stay above it.
        if (row.gap > 0) continue;
        EXPECT_FALSE(no_visit_below_before(row, 0.15)) << name_of(row);
    }
}

/// A map with a broken texel: NAN where a height that was tested was not a number, and nowhere
/// else.
testing::AssertionResult nan_where_it_was_met(const TraceRow& row, Planted planted) {
    Random random(8);
    const Map map = height_map(5, 5, [&](int x, int y) {
        return x == 3 && y == 1 ? std::numeric_limits<float>::quiet_NaN()
                                : static_cast<float>(random.uniform(0, 1));
    });
    int met_in_all = 0;
    for (int quad = 0; quad < 32; ++quad) {
        Batch<float> batch(4);
        fill_surface(batch, random, {0.1});
        batch.bind(TextureSlot::height, map.sampled);
        Visits visits;
        batch.log = &visits;
        run_baked({row.id}, batch, row.parameters);
        for (int i = 0; i < 4; ++i) {
            bool met = false;
            for (const MarchStep& step : visits.steps) {
                const float h = step.map_height.lane[i];
                met = met || (step.active.lane[i] && h != h);
            }
            met_in_all += met;
            const bool said =
                planted != Planted::nan_is_floor && status_of(batch, i) == Status::nan;
            if (met != said) return testing::AssertionFailure() << "quad " << quad;
        }
    }
    return met_in_all > 0 ? testing::AssertionSuccess()
                          : testing::AssertionFailure() << "no ray came by";
}

TEST(TraceVisits, NanIsReportedWhereItWasMet) {
    for (const TraceRow& row : trace_rows()) {
        if (row.kind == TraceKind::offset || !row.by_points || !row.takes_nan) continue;
        EXPECT_TRUE(nan_where_it_was_met(row, Planted::none)) << name_of(row);
        EXPECT_FALSE(nan_where_it_was_met(row, Planted::nan_is_floor)) << name_of(row);
    }
}

}  // namespace
}  // namespace quadrel::test
