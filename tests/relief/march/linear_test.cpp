// The linear search against a loop over plain floats, and its behaviour on maps whose answer is
// known.
#include "effort.hpp"
#include "relief/march/linear_search.hpp"

namespace quadrel::test {
namespace {

/// Maps of 1 to 40 texels a side, every wrap mode and filter, heights from -0.1 to 1.1, any seat.
testing::AssertionResult equals_loop(const Search& implementation, int batches) {
    for (int i = 0; i < batches; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Map map = make_map(
            1 + random.below(40), 1 + random.below(40), 1,
            [&](int, int, int) { return static_cast<float>(random.uniform(-0.1, 1.1)); },
            random_sampler(random));
        Batch<float> stage(64);
        fill_rays(stage, random, random.uniform(0, 0.2));
        stage.material.seat = random.chance(0.5) ? 1.0f : static_cast<float>(random.uniform(0, 1));
        stage.bind(TextureSlot::height, map.sampled);
        Batch<float> loop = stage;
        const int n = 1 + random.below(200);
        implementation.run(stage, {{"steps", n}});
        for (int lane = 0; lane < loop.lanes; ++lane) search_lane(loop, lane, n, Planted::none);
        const auto result = same_bits<float>(stage, loop, hit_values);
        if (!result) return testing::AssertionFailure() << result.message() << ", batch " << i;
    }
    return testing::AssertionSuccess();
}

TEST(Linear, IsTheFirstSampleBelow) {
    EXPECT_TRUE(equals_loop(linear(), rounds(150)));
    for (const Planted planted : {Planted::one_sample_late, Planted::one_sample_early,
                                  Planted::seat_forgotten, Planted::steps_counted_once}) {
        EXPECT_FALSE(equals_loop(linear(planted), 5)) << static_cast<int>(planted);
    }
}

// ---- Early and late -----------------------------------------------------------------------------

/// Random maps: never before the first sample of a march that is 16 times as dense.
testing::AssertionResult never_early(const Search& implementation) {
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        const Map map = noise_map(random, 32, 32);
        Batch<float> coarse(64);
        fill_rays(coarse, random);
        coarse.bind(TextureSlot::height, map.sampled);
        Batch<float> dense = coarse;
        implementation.run(coarse, {{"steps", 64}});
        dense.run("linear", {{"steps", 1024}});
        for (int lane = 0; lane < 64; ++lane) {
            const float s = coarse.real(Value::hit_s, lane), first = dense.real(Value::hit_s, lane);
            if (s < first) return testing::AssertionFailure() << s << " is before " << first;
        }
    }
    return testing::AssertionSuccess();
}

/// A map on which every ray of |K| < 1 crosses once: a triangle wave of slope below 1.
Map gentle_map() {
    return height_map(32, 32, [](int x, int y) {
        return static_cast<float>(std::abs(x - 16) + std::abs(y - 16)) / 64 + 0.25f;
    });
}

/// One crossing: found at the first sample behind it, at most 1/n late.
testing::AssertionResult at_most_a_step_late(const Search& implementation) {
    const Map map = gentle_map();
    Random random(6);
    Batch<float> coarse;
    fill_rays(coarse, random);
    coarse.bind(TextureSlot::height, map.sampled);
    Batch<float> dense = coarse;
    constexpr int n = 64;
    implementation.run(coarse, {{"steps", n}});
    dense.run("linear", {{"steps", 32 * n}});
    for (int lane = 0; lane < coarse.lanes; ++lane) {
        const float late = coarse.real(Value::hit_s, lane) - dense.real(Value::hit_s, lane);
        if (late < 1.0f / n) continue;
        return testing::AssertionFailure() << late * n << " steps late in lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(Linear, IsNeverEarlyAndAtMostAStepLate) {
    EXPECT_TRUE(never_early(linear()));
    EXPECT_FALSE(never_early(linear(Planted::one_sample_early)));
    EXPECT_TRUE(at_most_a_step_late(linear()));
    EXPECT_FALSE(at_most_a_step_late(linear(Planted::one_sample_late)));
}

// ---- Maps whose answer is known -----------------------------------------------------------------

/// Height m/256: the first k of n with k/n >= 1 - m/256, in integers.
testing::AssertionResult flat_maps_stop_at_their_depth(const Search& implementation) {
    Random random(8);
    for (const int n : {1, 7, 64, 100, 128}) {
        for (int m = 0; m <= 256; m += 8) {
            const Map map = flat_map(static_cast<float>(m) / 256);
            Batch<float> batch(16);
            fill_rays(batch, random);
            batch.bind(TextureSlot::height, map.sampled);
            implementation.run(batch, {{"steps", n}});
            const int k = ((256 - m) * n + 255) / 256;
            const float s = static_cast<float>(k) / static_cast<float>(n);
            const bool hit = batch.integer(Value::hit_status, 3) == static_cast<int>(Status::hit);
            if (hit && batch.real(Value::hit_s, 3) == s &&
                batch.integer(Value::hit_steps, 3) == k + 1) {
                continue;
            }
            return testing::AssertionFailure()
                   << "height " << m << "/256, " << n << " steps: " << batch.real(Value::hit_s, 3);
        }
    }
    return testing::AssertionSuccess();
}

TEST(Linear, FlatMapsStopAtTheirDepth) {
    EXPECT_TRUE(flat_maps_stop_at_their_depth(linear()));
    EXPECT_FALSE(flat_maps_stop_at_their_depth(linear(Planted::strict_comparison)));
}

/// K = 0, as frames give it for depth 0: the UV keeps its bits, whatever the map.
testing::AssertionResult without_depth_nothing_moves(const Search& implementation) {
    Random random(9);
    const Map map = noise_map(random, 16, 16);
    Batch<float> batch;
    fill_rays(batch, random);
    batch.material.depth = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) batch.set(Value::K, lane, dvec2(0));
    batch.bind(TextureSlot::height, map.sampled);
    implementation.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (batch.vector2(Value::hit_uv, lane) == batch.vector2(Value::uv, lane) &&
            batch.real(Value::hit_depth, lane) == 0) {
            continue;
        }
        return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(Linear, WithoutDepthNothingMoves) {
    EXPECT_TRUE(without_depth_nothing_moves(linear()));
    EXPECT_FALSE(without_depth_nothing_moves(
        {"linear", {}, [](Batch<float>& b) { b.real(Value::hit_uv, 3, 1) += 1e-6f; }}));
}

/// uv and K in multiples of 1/1024: sums and products with k/16 are exact.
void fill_dyadic_rays(Batch<float>& batch, Random& random) {
    fill_rays(batch, random);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        for (int c = 0; c < 2; ++c) {
            batch.real(Value::uv, lane, c) = static_cast<float>(random.below(2048)) / 1024;
            batch.real(Value::K, lane, c) = static_cast<float>(random.below(1024) - 512) / 1024;
        }
    }
}

/// A ray is the same wherever the polygon cuts it: seat 1 - p, and uv moved on by p K.
testing::AssertionResult seat_shifts_the_polygon(const Search& implementation) {
    Random random(10);
    const Map map = noise_map(random, 16, 16);
    Batch<float> inset(64);
    fill_dyadic_rays(inset, random);
    inset.bind(TextureSlot::height, map.sampled);
    Batch<float> seated = inset;
    seated.material.seat = 0.75f;
    for (int lane = 0; lane < 64; ++lane) {
        seated.set(Value::uv, lane,
                   inset.vector2(Value::uv, lane) + inset.vector2(Value::K, lane) * 0.25f);
    }
    implementation.run(inset, {{"steps", 16}});
    implementation.run(seated, {{"steps", 16}});
    constexpr auto same = values(Value::hit_uv, Value::hit_s, Value::hit_h, Value::hit_status);
    return same_bits<float>(inset, seated, same);
}

TEST(Linear, SeatShiftsThePolygon) {
    EXPECT_TRUE(seat_shifts_the_polygon(linear()));
    EXPECT_FALSE(seat_shifts_the_polygon(linear(Planted::seat_forgotten)));
}

/// Heights that vary with u alone, in 1/256: bilinear filtering is exact in either direction.
Map ridges(Random& random, bool mirrored) {
    std::array<float, 16> row;
    for (float& h : row) h = static_cast<float>(random.below(257)) / 256;
    if (mirrored) std::reverse(row.begin(), row.end());
    return height_map(16, 4, [row](int x, int) { return row[static_cast<std::size_t>(x)]; });
}

testing::AssertionResult mirrored_maps_mirror(const Search& implementation) {
    for (int i = 0; i < 20; ++i) {
        Random random(static_cast<std::uint64_t>(i)), again = random, rays(77);
        const Map map = ridges(random, false), mirror = ridges(again, true);
        Batch<float> one(64);
        fill_dyadic_rays(one, rays);
        Batch<float> other = one;
        one.bind(TextureSlot::height, map.sampled);
        other.bind(TextureSlot::height, mirror.sampled);
        for (int lane = 0; lane < 64; ++lane) {
            other.real(Value::uv, lane) = 1 - one.real(Value::uv, lane);
            other.real(Value::K, lane) = -one.real(Value::K, lane);
        }
        one.run("linear", {{"steps", 16}});
        implementation.run(other, {{"steps", 16}});
        for (int lane = 0; lane < 64; ++lane) {
            const float back = 1 - other.real(Value::hit_uv, lane);
            if (back == one.real(Value::hit_uv, lane) &&
                other.real(Value::hit_s, lane) == one.real(Value::hit_s, lane)) {
                continue;
            }
            return testing::AssertionFailure() << "map " << i << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Linear, MirroredMapsMirrorTheResult) {
    EXPECT_TRUE(mirrored_maps_mirror(linear()));
    EXPECT_FALSE(mirrored_maps_mirror(linear(Planted::one_sample_late)));
}

// ---- Status, flags, counts ----------------------------------------------------------------------

/// What a flat map of the given height ends with: status, s, flags.
struct End {
    Status status;
    float s;
    int flags;
};

End end_over(const Search& implementation, float height, Status frame = Status::hit) {
    Random random(12);
    const Map map = flat_map(height);
    Batch<float> batch(16);
    fill_rays(batch, random);
    for (int lane = 0; lane < 16; ++lane) {
        batch.integer(Value::frame_status, lane) = static_cast<int>(frame);
        batch.integer(Value::frame_flags, lane) = HitFlag::uv_degenerate;
    }
    batch.bind(TextureSlot::height, map.sampled);
    implementation.run(batch);
    return {static_cast<Status>(batch.integer(Value::hit_status, 5)), batch.real(Value::hit_s, 5),
            batch.integer(Value::hit_flags, 5)};
}

testing::AssertionResult ends_with(const Search& implementation, float height, const End& end) {
    const End got = end_over(implementation, height);
    if (got.status == end.status && got.s == end.s && got.flags == end.flags) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "status " << static_cast<int>(got.status) << ", s "
                                       << got.s << ", flags " << got.flags;
}

TEST(Linear, StatusSaysHowItEnded) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int of_frame = HitFlag::uv_degenerate;
    EXPECT_TRUE(ends_with(linear(), 0.0f, {Status::hit, 1, of_frame}));
    EXPECT_TRUE(ends_with(linear(), 1.0f, {Status::hit, 0, of_frame}));
    EXPECT_TRUE(ends_with(linear(), 1.25f, {Status::hit, 0, of_frame | HitFlag::start_below}));
    EXPECT_TRUE(ends_with(linear(), -0.25f, {Status::floor, 1, of_frame}));
    EXPECT_TRUE(ends_with(linear(), nan, {Status::nan, 1, of_frame}));
    EXPECT_FALSE(ends_with(linear(Planted::nan_is_floor), nan, {Status::nan, 1, of_frame}));
    EXPECT_FALSE(ends_with(linear(Planted::strict_comparison), 0, {Status::hit, 1, of_frame}));
}

/// Without a frame: the status of the frame, the undisplaced UV, no fetch.
TEST(Linear, LanesWithoutFrameStayOnThePolygon) {
    Random random(13);
    const Map map = noise_map(random, 16, 16);
    Batch<float> batch(64);
    fill_rays(batch, random);
    batch.material.seat = 0.5f;
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < 64; lane += 3) {
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::no_frame);
    }
    batch.run("linear");
    for (int lane = 0; lane < 64; lane += 3) {
        EXPECT_EQ(batch.integer(Value::hit_status, lane), static_cast<int>(Status::no_frame));
        EXPECT_EQ(batch.vector2(Value::hit_uv, lane), batch.vector2(Value::uv, lane));
        EXPECT_EQ(batch.real(Value::hit_depth, lane), 0);
        EXPECT_EQ(batch.integer(Value::hit_steps, lane), 0);
    }
}

/// Fetches are counted in active lanes alone, one per step.
testing::AssertionResult fetches_are_steps(const Search& implementation) {
    Random random(14);
    const Map map = noise_map(random, 16, 16);
    Batch<float> batch;
    fill_rays(batch, random);
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) batch.active[lane] = lane / 4 % 3 != 0;
    implementation.run(batch);
    std::uint64_t steps = 0;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const int taken = batch.integer(Value::hit_steps, lane);
        if (!batch.active[lane] && taken != 0) return testing::AssertionFailure() << "inactive";
        steps += static_cast<std::uint64_t>(taken);
    }
    return batch.fetches() == steps
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << batch.fetches() << " != " << steps;
}

TEST(Linear, FetchesAreSteps) {
    EXPECT_TRUE(fetches_are_steps(linear()));
    EXPECT_FALSE(fetches_are_steps(linear(Planted::steps_counted_once)));
}

}  // namespace
}  // namespace quadrel::test
