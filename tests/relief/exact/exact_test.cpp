// The exact searches: one another's equal bit for bit, and never wrong.
#include <cstdlib>
#include <optional>

#include "effort.hpp"
#include "relief/exact/exact_flaws.hpp"
#include "relief/exact/oracle_exact.hpp"

namespace quadrel::test {
namespace {

/// Batches of 256 rays a kind of map. Set QUADREL_EXACT_RAYS for more; a million take some minutes.
int batches_a_map() {
    const char* const rays = std::getenv("QUADREL_EXACT_RAYS");
    const long wanted = rays != nullptr ? std::atol(rays) : rounds(17408);
    return static_cast<int>(1 + wanted / (256 * static_cast<long>(stress_maps().size())));
}

/// `check(field, rays)` on batches of random rays over every kind of map, any size, wrap modes and
/// seat.
template <PlainFloat T, class Check>
testing::AssertionResult on_stress_maps(int batches, const Check& check) {
    // Maps take longer to bake than rays to search.
    const int batches_of_a_map = batches > 100 ? 10 : 1;
    for (const StressMap& kind : stress_maps()) {
        std::optional<ExactMaps> made;
        for (int i = 0; i < batches; ++i) {
            Random random(static_cast<std::uint64_t>(i) + 7);
            if (i % batches_of_a_map == 0) made.emplace(random_exact_maps(random, kind));
            const ExactMaps& maps = *made;
            Batch<float> rays;
            rays.material.seat =
                random.chance(0.5) ? 1.0f : static_cast<float>(random.below(5)) / 4;
            fill_stress_rays(rays, maps.height, random);
            Batch<T> batch = in_number<T>(rays);
            batch.material = rays.material;
            maps.bind(batch);
            const testing::AssertionResult result =
                check(oracle::Field(maps.height.sampled), batch);
            if (!result) {
                return testing::AssertionFailure()
                       << kind.name << ", batch " << i << ": " << result.message();
            }
        }
    }
    return testing::AssertionSuccess();
}

// ---- Agreement ----------------------------------------------------------------------------------

/// Hits and flags of `rows` are those of texel-exact; every lane searched has a hit or the floor.
template <PlainFloat T>
testing::AssertionResult agree(const std::vector<StageUnderTest<T>>& rows, int batches) {
    return on_stress_maps<T>(batches, [&](const oracle::Field&, Batch<T>& rays) {
        Batch<T> walked = searched(rays, "texel-exact");
        for (const StageUnderTest<T>& row : rows) {
            Batch<T> other = rays;
            row.run(other);
            for (int lane = 0; lane < rays.lanes; ++lane) {
                if (other.integer(Value::hit_status, lane) != int(Status::hit))
                    return testing::AssertionFailure()
                           << row.id << ": status " << other.integer(Value::hit_status, lane);
            }
            const auto same = same_bits<T>(walked, other, agreed_values);
            if (!same) return testing::AssertionFailure() << row.id << ": " << same.message();
        }
        return testing::AssertionSuccess();
    });
}

/// Side by side, since maps take longer to bake than rays to search.
template <PlainFloat T>
testing::AssertionResult all_agree() {
    std::vector<StageUnderTest<T>> rows;
    for (const char* const row : exact_rows) rows.push_back(exact<T>(row));
    return agree(rows, batches_a_map());
}

TEST(Exact, SearchesAgreeBitForBit) {
    EXPECT_TRUE(all_agree<float>());
    EXPECT_TRUE(all_agree<double>());
    for (const Planted planted : {Planted::leap_without_margin, Planted::leap_from_entry,
                                  Planted::late_border, Planted::corner_cell_skipped}) {
        EXPECT_FALSE(agree<float>({exact<float>("max-mip", planted)}, 1)) << int(planted);
    }
}

// ---- None wrong ---------------------------------------------------------------------------------

template <PlainFloat T>
testing::AssertionResult is_never_wrong(const StageUnderTest<T>& row, int batches) {
    return on_stress_maps<T>(batches, [&](const oracle::Field& field, Batch<T>& rays) {
        Batch<T> found = rays;
        row.run(found);
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const auto result =
                is_not_wrong(field, oracle_ray(rays, lane), found.real(Value::hit_s, lane));
            if (!result) return testing::AssertionFailure() << "lane " << lane << result.message();
        }
        return testing::AssertionSuccess();
    });
}

TEST(Exact, NoHitIsWrong) {
    EXPECT_TRUE(is_never_wrong(exact<float>("texel-exact"), batches_a_map()));
    EXPECT_TRUE(is_never_wrong(exact<double>("texel-exact"), batches_a_map()));
    for (const Planted planted : {Planted::leap_from_entry, Planted::late_border,
                                  Planted::corner_cell_skipped, Planted::wrong_wrap}) {
        EXPECT_FALSE(is_never_wrong(exact<float>("max-mip", planted), 2)) << int(planted);
        EXPECT_FALSE(is_never_wrong(exact<double>("max-mip", planted), 2)) << int(planted);
    }
}

/// Rays over thousands of cells down to a relief that is a 64th of the depth.
template <PlainFloat T>
testing::AssertionResult long_rays_do_not_drift(const StageUnderTest<T>& row) {
    Random random(3);
    const ExactMaps maps(height_map(63, 65, [](int x, int y) { return (x + y) % 2 / 64.0f; }));
    Batch<float> rays(32);
    fill_stress_rays(rays, maps.height, random);
    for (int lane = 0; lane < rays.lanes; ++lane)
        rays.set(Value::K, lane, dvec2(random.uniform(20, 57), random.uniform(-57, 57)));
    Batch<T> batch = in_number<T>(rays);
    maps.bind(batch);
    row.run(batch);
    const oracle::Field field(maps.height.sampled);
    for (int lane = 0; lane < rays.lanes; ++lane) {
        const auto result = is_not_wrong(field, oracle_ray(batch, lane),
                                         batch.real(Value::hit_s, lane), oracle::Real(1) / 64);
        if (!result) return result;
    }
    return testing::AssertionSuccess();
}

TEST(Exact, LongRaysDoNotDrift) {
    for (const char* row : exact_rows) {
        EXPECT_TRUE(long_rays_do_not_drift(exact<float>(row))) << row;
        EXPECT_TRUE(long_rays_do_not_drift(exact<double>(row))) << row;
    }
    EXPECT_FALSE(long_rays_do_not_drift(exact<float>("texel-exact", Planted::accumulated_borders)));
}

/// Where moving all heights by eight roundings makes the hit jump, the hit is flagged.
template <PlainFloat T>
testing::AssertionResult flags_grazes(const StageUnderTest<T>& row, int batches) {
    return on_stress_maps<T>(batches, [&](const oracle::Field& field, Batch<T>& rays) {
        constexpr oracle::Real nudge = 4 * std::numeric_limits<T>::epsilon();
        Batch<T> found = rays;
        row.run(found);
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const oracle::Ray ray = oracle_ray(rays, lane);
            const oracle::Real first = oracle::meet_bilinear(field, ray, nudge).s;
            const oracle::Real last = oracle::meet_bilinear(field, ray, -nudge).s;
            const bool flagged = (found.integer(Value::hit_flags, lane) & HitFlag::ambiguous) != 0;
            if (last - first <= std::sqrt(nudge) * 64 || flagged) continue;
            return testing::AssertionFailure()
                   << "lane " << lane << ": between " << double(first) << " and " << double(last);
        }
        return testing::AssertionSuccess();
    });
}

TEST(Exact, GrazesAreFlagged) {
    EXPECT_TRUE(flags_grazes(exact<float>("texel-exact"), batches_a_map()));
    EXPECT_TRUE(flags_grazes(exact<double>("texel-exact"), batches_a_map()));
    EXPECT_FALSE(flags_grazes(exact<float>("texel-exact", Planted::grazes_unflagged), 2));
}

// ---- Rational arithmetic ------------------------------------------------------------------------

/// In double, a hit that is not flagged is the one that rational arithmetic decides on.
testing::AssertionResult unflagged_hits_are_decided(const StageUnderTest<double>& row) {
    return on_stress_maps<double>(1, [&](const oracle::Field& field, Batch<double>& rays) {
        Batch<double> found = rays;
        row.run(found);
        for (int lane = 0; lane < 64; ++lane) {
            if (found.integer(Value::hit_flags, lane) & HitFlag::ambiguous) continue;
            const double s = found.real(Value::hit_s, lane);
            const oracle::Hit hit = oracle::meet_bilinear_exactly(field, oracle_ray(rays, lane));
            if (std::fabs(s - hit.s) > 1e-6L)
                return testing::AssertionFailure()
                       << "lane " << lane << ": " << s << " for " << double(hit.s);
        }
        return testing::AssertionSuccess();
    });
}

TEST(Exact, UnflaggedHitsAreThoseOfRationals) {
    EXPECT_TRUE(unflagged_hits_are_decided(exact<double>("texel-exact")));
    for (const Planted planted : {Planted::late_border, Planted::wrong_wrap})
        EXPECT_FALSE(unflagged_hits_are_decided(exact<double>("texel-exact", planted)));
}

}  // namespace
}  // namespace quadrel::test
