// The judge's stages: what they store is what the judge says, in float and in double, beside the
// exact searches.
#include "relief/oracle/judged.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using judge::Surface;

constexpr std::array traces{"oracle-bilinear", "oracle-block", "oracle-tri-main", "oracle-tri-anti",
                            "oracle-tri-min"};

template <PlainFloat T>
void bind(Batch<T>& batch, const JudgedMap& map) {
    batch.bind(TextureSlot::height, map.height.sampled);
    batch.bind(TextureSlot::max_mip, map.maxima.sampled);
}

/// Rays over a map of each kind.
void on_maps(const std::function<void(const JudgedMap&, Batch<float>&)>& check) {
    for (const StressMap& kind : stress_maps()) {
        Random random(static_cast<std::uint64_t>(kind.name[1]) + 7);
        const JudgedMap map(random_stress_map(random, kind, 24));
        Batch<float> rays(64);
        fill_stress_rays(rays, map.height, random);
        bind(rays, map);
        check(map, rays);
    }
}

/// Everything of a lane is what the judge says of its ray, s within the bound that is stored.
template <PlainFloat T>
testing::AssertionResult stores_hit(Batch<T>& batch, int lane, const judge::Hit& hit) {
    const auto is = [&](Value v, double first, double second = 0) {
        return batch.real(v, lane) == static_cast<T>(first) &&
               (info(v).components < 2 || batch.real(v, lane, 1) == static_cast<T>(second));
    };
    const double s = batch.real(Value::oracle_s, lane),
                 bound = batch.real(Value::oracle_bound, lane);
    if (!is(Value::oracle_s, hit.s) || !is(Value::oracle_uv, hit.u, hit.v))
        return testing::AssertionFailure() << "s or uv of lane " << lane;
    if (!is(Value::oracle_cell, hit.cell_x, hit.cell_y) ||
        !is(Value::oracle_place, hit.place_x, hit.place_y) ||
        !is(Value::oracle_gradient, hit.gradient_u, hit.gradient_v) ||
        !is(Value::oracle_condition, hit.condition))
        return testing::AssertionFailure() << "cell, place or slope of lane " << lane;
    // The exact hit is in [hit.s - hit.bound, hit.s + hit.bound].
    if (!(s - bound <= hit.s - hit.bound && hit.s + hit.bound <= s + bound))
        return testing::AssertionFailure() << "bound " << bound << " of lane " << lane;
    if (batch.integer(Value::certified, lane) != static_cast<int>(hit.certificate) ||
        batch.integer(Value::certified_reason, lane) != static_cast<int>(hit.reason) ||
        batch.integer(Value::oracle_status, lane) != static_cast<int>(hit.status))
        return testing::AssertionFailure() << "certificate of lane " << lane;
    return testing::AssertionSuccess();
}

template <PlainFloat T>
testing::AssertionResult store_hits(const JudgedMap& map, Batch<T> batch, Surface surface,
                                    const Parameters& parameters, const std::string& id,
                                    Planted planted = Planted::none) {
    batch.run(id, parameters);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        judge::Hit hit = judge::first_hit(map.field(surface), judged_ray(batch, lane));
        if (planted == Planted::bound_too_small)
            batch.real(Value::oracle_bound, lane) = static_cast<T>(hit.bound / 2);
        if (planted == Planted::unproven_as_proven) hit.certificate = Certificate::none;
        const auto result = stores_hit(batch, lane, hit);
        if (!result) return testing::AssertionFailure() << id << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

TEST(OracleStages, StoreWhatTheJudgeSays) {
    int noticed = 0;
    on_maps([&](const JudgedMap& map, Batch<float>& rays) {
        for (const Surface surface : surfaces) {
            const auto k = static_cast<std::size_t>(surface);
            const Parameters chosen{{"surface", double(k)}};
            EXPECT_TRUE(store_hits(map, rays, surface, chosen, "oracle"));
            EXPECT_TRUE(store_hits(map, in_double(rays), surface, chosen, "oracle"));
            EXPECT_TRUE(store_hits(map, rays, surface, {}, traces[k]));
        }
        for (const Planted planted : {Planted::bound_too_small, Planted::unproven_as_proven})
            noticed += !store_hits(map, rays, Surface::bilinear, {}, "oracle", planted);
    });
    // A bound of 0 may be halved.
    EXPECT_GT(noticed, int(stress_maps().size()) * 3 / 2);
}

/// As a trace: hit.* are oracle.*, and a hit's height is where the ray is, or above where it
/// starts.
TEST(OracleStages, TracesHandTheirHitsOn) {
    on_maps([&](const JudgedMap&, Batch<float>& rays) {
        for (const char* id : traces) {
            Batch<float> found = searched(rays, id);
            for (int lane = 0; lane < rays.lanes; ++lane) {
                EXPECT_EQ(found.real(Value::hit_s, lane), found.real(Value::oracle_s, lane));
                const dvec2 off = dvec2(found.vector2(Value::hit_uv, lane)) -
                                  dvec2(found.vector2(Value::oracle_uv, lane));
                EXPECT_LT(length(off), 1e-4) << id;
                EXPECT_EQ(found.integer(Value::hit_status, lane),
                          found.integer(Value::oracle_status, lane));
                const float over =
                    found.real(Value::hit_h, lane) - (1 - found.real(Value::hit_s, lane));
                const bool above =
                    id == std::string("oracle-block") || found.real(Value::hit_s, lane) == 0;
                EXPECT_LE(over, above ? 1 : 1e-5) << id;
                EXPECT_GE(over, -1e-5) << id;
            }
        }
    });
}

/// texel-exact and max-mip in double agree with it, up to their own rounding.
testing::AssertionResult exact_rows_agree(double late) {
    testing::AssertionResult result = testing::AssertionSuccess();
    on_maps([&](const JudgedMap& map, Batch<float>& rays) {
        const oracle::Field field(map.height.sampled);
        Batch<double> wide = in_double(rays);
        bind(wide, map);
        Batch<double> truth = searched(wide, "oracle-bilinear");
        for (const char* row : {"texel-exact", "max-mip"}) {
            Batch<double> found = searched(wide, row);
            for (int lane = 0; lane < wide.lanes; ++lane) {
                const double s = found.real(Value::hit_s, lane) + late;
                const oracle::Ray ray = oracle_ray(wide, lane);
                const oracle::Real error = height_error<double>(field, ray, 1);
                const double off = std::fabs(s - truth.real(Value::oracle_s, lane));
                const double reach =
                    8 * double(error) * (1 + truth.real(Value::oracle_condition, lane)) +
                    truth.real(Value::oracle_bound, lane);
                // A graze is another surface to who cannot tell.
                const int flags = found.integer(Value::hit_flags, lane);
                if (off > reach && !(flags & HitFlag::ambiguous) &&
                    !is_not_wrong<double>(field, ray, s))
                    result = testing::AssertionFailure() << row << ": off by " << off;
            }
        }
    });
    return result;
}

TEST(OracleStages, AgreeWithExactSearches) {
    EXPECT_TRUE(exact_rows_agree(0));
    EXPECT_FALSE(exact_rows_agree(1e-6));
}

TEST(OracleStages, SayWhatIsMissing) {
    const JudgedMap map(flat_map(0.5f, 8));
    Random random(1);
    Batch<float> rays(16);
    fill_stress_rays(rays, map.height, random);
    bind(rays, map);
    rays.integer(Value::frame_status, 2) = static_cast<int>(Status::no_frame);
    rays.run("oracle");
    EXPECT_EQ(rays.integer(Value::certified_reason, 2), static_cast<int>(Uncertified::no_ray));
    EXPECT_EQ(rays.integer(Value::oracle_status, 2), static_cast<int>(Status::no_frame));
    EXPECT_EQ(rays.integer(Value::certified, 2), 0);
    EXPECT_EQ(rays.integer(Value::certified, 1), static_cast<int>(Certificate::bounds));
    rays.unbind(TextureSlot::height);
    rays.run("oracle");
    EXPECT_EQ(rays.integer(Value::certified_reason, 1),
              static_cast<int>(Uncertified::no_height_map));
    EXPECT_EQ(rays.integer(Value::oracle_status, 1), static_cast<int>(Status::none));
    EXPECT_EQ(rays.integer(Value::oracle_status, 2), static_cast<int>(Status::no_frame));
}

}  // namespace
}  // namespace quadrel::test
