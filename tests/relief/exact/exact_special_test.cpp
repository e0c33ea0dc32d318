// Exact searches on maps and rays whose answer is known, and on such as break searches.
#include "relief/exact/exact_flaws.hpp"

namespace quadrel::test {
namespace {

constexpr std::array all_rows{"texel-exact", "max-mip", "cone-cell", "rmq-leap",
                              "ddm",         "qdm",     "pyramid"};

/// 16 rays over a map, K and uv from a seed; K = 0 for a quarter.
struct Rays {
    ExactMaps maps;
    Batch<float> batch{16};

    explicit Rays(Map map, std::uint64_t seed = 1) : maps(std::move(map)) {
        Random random(seed);
        fill_stress_rays(batch, maps.height, random);
        for (int lane = 0; lane < 4; ++lane) batch.set(Value::K, lane, dvec2(0, 0));
        maps.bind(batch);
    }
    Status status(int lane) { return static_cast<Status>(batch.integer(Value::hit_status, lane)); }
    float s(int lane) { return batch.real(Value::hit_s, lane); }
    bool flagged(int lane, std::int32_t flag) {
        return (batch.integer(Value::hit_flags, lane) & flag) != 0;
    }
};

/// A row, its results changed afterwards.
using Changed = std::function<void(Batch<float>&)>;

testing::AssertionResult flat_maps_stop_at_their_depth(const char* row, const Changed& change) {
    for (const int side : {1, 2, 7}) {
        for (int m = 0; m <= 8; ++m) {
            Rays rays(flat_map(static_cast<float>(m) / 8, side), static_cast<std::uint64_t>(m));
            rays.batch.run(row);
            change(rays.batch);
            for (int lane = 0; lane < 16; ++lane) {
                const float expected = 1 - static_cast<float>(m) / 8;
                const bool near = std::abs(rays.s(lane) - expected) <= (lane < 4 ? 0 : 4e-7f);
                if (near && rays.status(lane) == Status::hit) continue;
                return testing::AssertionFailure()
                       << row << " at height " << m << "/8: " << rays.s(lane);
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(ExactSpecial, FlatMapsStopAtTheirDepth) {
    for (const char* row : all_rows) EXPECT_TRUE(flat_maps_stop_at_their_depth(row, [](auto&) {}));
    EXPECT_FALSE(flat_maps_stop_at_their_depth(
        "max-mip", [](Batch<float>& batch) { batch.real(Value::hit_s, 2) += 6e-8f; }));
}

/// A column without finite heights: rays that come to it report NAN, others are as without it.
testing::AssertionResult breaks_at(const char* row, float broken, const Changed& change) {
    const auto map = [](float middle) {
        return height_map(32, 8, [=](int x, int) { return x == 16 ? middle : 0.25f; });
    };
    Rays rays(map(0.25f));
    // Down to s = 3/4 from u = 1/8: short of the column, or through it.
    for (int lane = 0; lane < 16; ++lane) {
        rays.batch.set(Value::uv, lane, dvec2(0.125, 0.3));
        rays.batch.set(Value::K, lane, dvec2(lane % 2 == 0 ? 0.25 : 0.75, 0.1));
    }
    const Map other = map(broken);
    rays.batch.bind(TextureSlot::height, other.sampled);
    std::array<Map, texture_slot_count> baked;
    for (const TextureSlot slot :
         {TextureSlot::max_mip, TextureSlot::texel_max, TextureSlot::rmq}) {
        Map& to = baked[std::size_t(slot)];
        to.texture = bake(*other.texture, bake_kind_from_name(slot_name(slot)), plain_sampler());
        to.sampled = {to.texture->view(), plain_sampler()};
        rays.batch.bind(slot, to.sampled);
    }
    rays.batch.run(row);
    change(rays.batch);
    for (int lane = 0; lane < 16; ++lane) {
        const Status expected = lane % 2 == 0 ? Status::hit : Status::nan;
        if (rays.status(lane) != expected)
            return testing::AssertionFailure() << row << ", " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(ExactSpecial, BrokenHeightsAreNan) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const char* row : {"texel-exact", "max-mip", "rmq-leap", "qdm", "pyramid"})
        EXPECT_TRUE(breaks_at(row, nan, [](auto&) {})) << row;
    EXPECT_FALSE(breaks_at("texel-exact", 0.25f, [](auto&) {}));
}

/// `holds(row)` of all rows, and not of max-mip where its results are changed.
template <class Property>
void expect_of_all_rows(const Property& holds, const Changed& flaw) {
    for (const char* row : all_rows) EXPECT_TRUE(holds(row, [](Batch<float>&) {}));
    EXPECT_FALSE(holds("max-mip", flaw));
}
void in_all_lanes(Batch<float>& batch, Value v, int add) {
    for (int lane = 0; lane < batch.lanes; ++lane) batch.integer(v, lane) += add;
}
testing::AssertionResult same(bool equal, const char* row, int lane) {
    if (equal) return testing::AssertionSuccess();
    return testing::AssertionFailure() << row << ", lane " << lane;
}

/// Rays that are no numbers, that lead too far, and lanes without a frame end at once, each with
/// its status.
testing::AssertionResult unsearchable_rays_say_so(const char* row, const Changed& change) {
    const float infinity = std::numeric_limits<float>::infinity();
    Rays rays(flat_map(0.5f, 5));
    rays.batch.set(Value::K, 5, vec2<float>(infinity, 0));
    rays.batch.set(Value::uv, 6, vec2<float>(0, infinity - infinity));
    rays.batch.set(Value::K, 7, vec2<float>(1e7f, 3));
    rays.batch.integer(Value::frame_status, 8) = static_cast<int>(Status::no_frame);
    rays.batch.run(row);
    change(rays.batch);
    const std::pair<int, Status> expected[] = {{5, Status::nan},
                                               {6, Status::nan},
                                               {7, Status::cap},
                                               {8, Status::no_frame},
                                               {9, Status::hit}};
    for (const auto& [lane, status] : expected)
        if (rays.status(lane) != status) return same(false, row, lane);
    return same(rays.s(7) == 0 && rays.batch.integer(Value::hit_steps, 8) == 0, row, 7);
}

TEST(ExactSpecial, UnsearchableRaysSaySo) {
    expect_of_all_rows(unsearchable_rays_say_so, [](Batch<float>& batch) {
        batch.integer(Value::hit_status, 7) = static_cast<int>(Status::floor);
    });
}

/// Clamped axes have no such limit: a ray that leaves the texture ends in its last cell.
testing::AssertionResult clamped_rays_end_in_the_corner(const char* row, const Changed& change) {
    Rays rays(height_map(
        16, 16, [](int x, int y) { return float(x + y) / 64; }, Wrap::clamp_to_edge));
    for (int lane = 0; lane < 16; ++lane) {
        rays.batch.set(Value::uv, lane, dvec2(0.5, 0.5));
        rays.batch.set(Value::K, lane, dvec2(1e7, lane % 2 == 0 ? 1e7 : -1e7));
    }
    rays.batch.run(row);
    change(rays.batch);
    for (int lane = 0; lane < 16; ++lane) {
        const float corner = lane % 2 == 0 ? 30.0f / 64 : 15.0f / 64;  // texel (15, 15), (15, 0)
        const bool there = std::abs(rays.s(lane) - (1 - corner)) < 1e-6f;
        if (!there || rays.batch.integer(Value::hit_steps, lane) > 200)
            return same(false, row, lane);
    }
    return testing::AssertionSuccess();
}

TEST(ExactSpecial, ClampedRaysLeaveAtOnce) {
    expect_of_all_rows(clamped_rays_end_in_the_corner,
                       [](Batch<float>& batch) { in_all_lanes(batch, Value::hit_steps, 1000); });
}

/// The flag is for hits in another tile than the fragment's.
testing::AssertionResult wrapped_means_another_tile(const char* row, const Changed& change) {
    Rays rays(flat_map(0.5f, 8));
    for (int lane = 0; lane < 16; ++lane) {
        rays.batch.set(Value::uv, lane, dvec2(0.5, 3.25));
        rays.batch.set(Value::K, lane, dvec2(lane < 8 ? 0.9 : 1.1, 0));
    }
    rays.batch.run(row);
    change(rays.batch);
    for (int lane = 0; lane < 16; ++lane)
        if (rays.flagged(lane, HitFlag::wrapped) != (lane >= 8)) return same(false, row, lane);
    return testing::AssertionSuccess();
}

TEST(ExactSpecial, WrappedMeansAnotherTile) {
    expect_of_all_rows(wrapped_means_another_tile, [](Batch<float>& batch) {
        batch.integer(Value::hit_flags, 3) |= HitFlag::wrapped;
    });
}

/// Heights above 1 are met at the start, and say so; below 0 nothing is met.
testing::AssertionResult heights_beyond_the_relief_are_said(const char* row,
                                                            const Changed& change) {
    Rays high(flat_map(1.25f, 4)), low(flat_map(-0.25f, 4));
    high.batch.run(row);
    low.batch.run(row);
    change(high.batch);
    for (int lane = 0; lane < 16; ++lane) {
        const bool starts_below = high.s(lane) == 0 && high.flagged(lane, HitFlag::start_below);
        const bool floor = low.status(lane) == Status::floor && low.s(lane) == 1;
        if (!starts_below || !floor) return same(false, row, lane);
    }
    return testing::AssertionSuccess();
}

TEST(ExactSpecial, HeightsBeyondTheReliefAreSaid) {
    expect_of_all_rows(heights_beyond_the_relief_are_said, [](Batch<float>& batch) {
        batch.integer(Value::hit_flags, 3) &= ~HitFlag::start_below;
    });
}

/// Whole tiles further on, the hits have the same s, bit for bit.
testing::AssertionResult tiles_are_equal(const char* row, const Changed& change) {
    Random random(9);
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat}) {
        const Map map = noise_map(random, 16, 16, wrap);
        Rays near(map), far(map);
        for (int lane = 0; lane < 16; ++lane) {
            const double u = random.below(256) / 256.0, v = random.below(256) / 256.0;
            near.batch.set(Value::uv, lane, dvec2(u, v));
            far.batch.set(Value::uv, lane, dvec2(u + 16384, v - 8192));
        }
        near.batch.run(row);
        far.batch.run(row);
        change(far.batch);
        for (int lane = 0; lane < 16; ++lane)
            if (near.s(lane) != far.s(lane)) return same(false, row, lane);
    }
    return testing::AssertionSuccess();
}

TEST(ExactSpecial, TilesAreEqual) {
    expect_of_all_rows(tiles_are_equal,
                       [](Batch<float>& batch) { batch.real(Value::hit_s, 3) *= 0.9999999f; });
}

/// Every look-up is counted once, in its slot and in the lane's total; a walk takes one per cell,
/// and no more cells than it can cross.
testing::AssertionResult counts_are_true(const char* row, const Changed& change) {
    Random random(10);
    Rays rays(noise_map(random, 24, 24));
    rays.batch.run(row);
    change(rays.batch);
    std::uint64_t sum = 0;
    for (int lane = 0; lane < 16; ++lane) {
        const int fetches = rays.batch.integer(Value::hit_fetches, lane);
        sum += static_cast<std::uint64_t>(fetches);
        if (row != std::string("texel-exact")) continue;
        const double cells = 24 * (std::abs(rays.batch.real(Value::K, lane, 0)) +
                                   std::abs(rays.batch.real(Value::K, lane, 1)));
        const bool one_a_cell = fetches == rays.batch.integer(Value::hit_steps, lane);
        if (!one_a_cell || fetches > std::floor(cells) + 3) return same(false, row, lane);
    }
    return same(sum == rays.batch.fetches(), row, 0);
}

TEST(ExactSpecial, CountsAreTrue) {
    expect_of_all_rows(counts_are_true,
                       [](Batch<float>& batch) { in_all_lanes(batch, Value::hit_fetches, 1); });
}

}  // namespace
}  // namespace quadrel::test
