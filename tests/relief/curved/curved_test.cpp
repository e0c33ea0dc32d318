// Searches of relief over curved surfaces: of a flat one they are plain relief mapping; of any
// heights they meet the first.
#include "effort.hpp"
#include "quadrel/relief/trace/curved/curved_path.hpp"
#include "relief/curved/curved_rows.hpp"
#include "relief/exact/oracle.hpp"

namespace quadrel::test {
namespace {

// ---- Of flat surfaces ---------------------------------------------------------------------------

/// Planes under a noisy map, no curvature.
struct FlatRays {
    Map map;
    Batch<float> batch{64};

    explicit FlatRays(int seed, float seat) {
        Random random(static_cast<std::uint64_t>(seed) + 40);
        map = noise_map(random, 16, 16);
        fill_surface(batch, random, {.least_r = 0.15, .depth = 0.1});
        batch.material.seat = seat;
        batch.bind(TextureSlot::height, map.sampled);
        each(batch, [&](int lane) { batch.set(Value::quadric, lane, dvec2(0)); });
    }
    FlatRays(const FlatRays&) = delete;
};

/// With quadrics of 0 it is relief-binary, bit for bit.
testing::AssertionResult is_relief_mapping(const CurvedRow& row) {
    for (int seed = 0; seed < rounds(16); ++seed) {
        FlatRays rays(seed, 1);
        const Parameters parameters{{"steps", 7 + seed}, {"binary_steps", seed % 8}};
        Batch<float> plain = rays.batch;
        plain.run("relief-binary", parameters);
        row.run(rays.batch, parameters);
        const auto result = same_bits<float>(plain, rays.batch, trace_outputs);
        if (!result) return testing::AssertionFailure() << seed << ": " << result.message();
    }
    return testing::AssertionSuccess();
}

TEST(CurvedQuadric, OfNoCurvatureIsReliefMapping) {
    EXPECT_TRUE(is_relief_mapping({"curved-quadric"}));
    EXPECT_FALSE(is_relief_mapping(
        {"curved-quadric", [](Batch<float>& b) { b.set(Value::quadric, 7, dvec2(1e-3, 0)); }}));
}

/// The frame is what it was before the search.
testing::AssertionResult keeps_the_frame(const CurvedRow& row) {
    for (int seed = 0; seed < rounds(4); ++seed) {
        FlatRays rays(seed, 0.5f);
        Batch<float> given = rays.batch;
        row.run(rays.batch);
        const auto result = same_bits<float>(
            given, rays.batch, values(Value::frame_normal, Value::T, Value::B, Value::J));
        if (!result) return result;
    }
    return testing::AssertionSuccess();
}

TEST(CurvedRows, OfFlatSurfacesKeepTheFrame) {
    for (const char* id : curved_rows) EXPECT_TRUE(keeps_the_frame({id})) << id;
    EXPECT_FALSE(keeps_the_frame(
        {"curved-quadric", [](Batch<float>& b) { b.set(Value::quadric, 7, dvec2(0.1, 0)); }}));
}

/// Without turning normals it is relief-binary but for rounding, wherever the polygon is seated.
testing::AssertionResult is_nearly_relief_mapping(const CurvedRow& row, float seat) {
    int compared = 0, off = 0;
    for (int seed = 0; seed < rounds(16); ++seed) {
        FlatRays rays(seed, seat);
        const Parameters parameters{{"steps", 24}, {"binary_steps", 6}};
        Batch<float> plain = rays.batch;
        plain.run("relief-binary", parameters);
        row.run(rays.batch, parameters);
        each(plain, [&](int lane) {
            ++compared;
            const double s = plain.real(Value::hit_s, lane);
            const dvec2 uv(plain.vector2(Value::hit_uv, lane));
            const bool equal = plain.integer(Value::hit_status, lane) ==
                                   rays.batch.integer(Value::hit_status, lane) &&
                               std::abs(rays.batch.real(Value::hit_s, lane) - s) < 1e-4 &&
                               length(dvec2(rays.batch.vector2(Value::hit_uv, lane)) - uv) < 1e-4 &&
                               std::abs(rays.batch.real(Value::hit_depth, lane) -
                                        plain.real(Value::hit_depth, lane)) < 1e-5;
            off += !equal;
        });
    }
    // A sample next to the surface may be on either side of it.
    if (50 * off <= compared) return testing::AssertionSuccess();
    return testing::AssertionFailure() << row.id << ": " << off << " of " << compared;
}

TEST(CurvedRows, OfFlatSurfacesAreReliefMapping) {
    const auto turned = [](Batch<float>& b) {
        for (int lane = 1; lane < b.lanes; lane += 2)
            b.real(Value::vertex_normal, lane, 0) += 0.001f;
    };
    const auto curved = [](Batch<float>& b) {
        each(b, [&](int lane) { b.set(Value::quadric, lane, dvec2(1)); });
    };
    for (const float seat : {1.0f, 0.75f, 0.25f}) {
        for (const char* id : curved_rows) EXPECT_TRUE(is_nearly_relief_mapping({id}, seat)) << id;
        EXPECT_FALSE(is_nearly_relief_mapping({"prism-free", turned}, seat));
        EXPECT_FALSE(is_nearly_relief_mapping({"curved-quadric", curved}, seat));
    }
}

// ---- Of any heights -----------------------------------------------------------------------------

/// No sample of a row's path before its hit is in the relief: its own points are followed a
/// thousand to a ray by the sphere's geometry.
testing::AssertionResult meets_the_first(const CurvedRow& row) {
    int hits = 0, misses = 0, off = 0;
    for (int seed = 0; seed < rounds(8); ++seed) {
        Random random(static_cast<std::uint64_t>(seed) + 70);
        Batch<float> batch(64);
        const Map map = height_map(16, 16, [](int x, int y) {
            const auto wave = [](int k) { return std::abs(static_cast<float>(k - 8)) / 8; };
            return 0.2f + 0.7f * wave(x) * wave(y);
        });
        SphereOptions options = grazing;
        options.depth = 0.03;
        options.density = 2;
        const Spheres spheres(batch, random, options);
        batch.bind(TextureSlot::height, map.sampled);
        Batch<float> given = batch;
        row.run(batch, {{"steps", 512}, {"binary_steps", 10}});
        const oracle::Field field(map.sampled);
        each(batch, [&](int lane) {
            const SphereRay ray(given, lane, spheres);
            const auto gap = [&](double t) {
                const dvec2 uv = ray.uv_at(t);
                const double h =
                    static_cast<double>(field.bilinear(uv.x * 16 - 0.5, uv.y * 16 - 0.5));
                return (1 - ray.depth_at(t) / options.depth) - h;
            };
            const double end = 2.05 * ray.turning();
            double first = end, least = 1;
            for (int k = 0; k < 1000 && first == end; ++k) {
                const double t = end * k / 1000;
                least = std::min(least, gap(t));
                if (gap(t) <= 0) first = t;
            }
            const bool hit = batch.integer(Value::hit_status, lane) == int(Status::hit);
            hit ? ++hits : ++misses;
            if (std::abs(least) < 0.02 && first == end) return;  // a graze
            const double t =
                double(batch.real(Value::hit_depth, lane)) / double(batch.real(Value::r, lane));
            off += hit != (first < end) || (hit && std::abs(gap(t)) > 0.03) ||
                   (hit && std::abs(t - first) > 0.01 * end);
        });
    }
    if (50 * off <= hits && hits > rounds(200) && misses > rounds(50))
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << row.id << ": " << off << " off, " << hits << " hits, " << misses << " misses";
}

TEST(PrismFree, MeetsTheFirstSurfaceOnASphere) {
    EXPECT_TRUE(meets_the_first({"prism-free"}));
    EXPECT_FALSE(meets_the_first({"prism-free", [](Batch<float>& b) {
                                      each(b,
                                           [&](int lane) { b.real(Value::uv, lane, 0) += 0.1f; });
                                  }}));
    EXPECT_FALSE(meets_the_first({"relief-binary"}));
}

/// Where normals meet within a step, as of quads that are next to a line in texture space, rays end
/// somewhere, by numbers.
TEST(PrismFree, RaysStayWhereNormalsMeet) {
    int turned = 0;
    for (int seed = 0; seed < rounds(16); ++seed) {
        SphereRays rays(0.5f, grazing, Random(seed));
        Batch<float>& b = rays.batch;
        Random random(seed + 100);
        each(b, [&](int lane) {
            // dUVdx and dUVdy along (3, 2), but for rounding.
            const float along = static_cast<float>(random.uniform(-3, 3));
            const dvec2 line(3, 2), rounded(random.uniform(0, 1e-4), 0);
            b.set(Value::dUVdx, lane, line * double(along) + rounded * double(seed % 4));
            b.set(Value::dUVdy, lane, line * 1e-3);
        });
        b.run("prism-free");
        each(b, [&](int lane) {
            for (int c = 0; c < 6; ++c) EXPECT_TRUE(std::isfinite(b.real(Value::J, lane, c)));
            for (int c = 0; c < 2; ++c) EXPECT_TRUE(std::isfinite(b.real(Value::hit_uv, lane, c)));
            EXPECT_TRUE(std::isfinite(b.real(Value::hit_s, lane)));
            EXPECT_FALSE(std::isnan(b.real(Value::frame_normal, lane)));
            turned += rays.status(lane) != Status::hit;
        });
    }
    EXPECT_GT(turned, 0);
}

TEST(CurvedRows, OppositeNormalsTurnToNumbers) {
    Random random(5);
    for (int i = 0; i < 100; ++i) {
        const vec3<float> from(random_direction(random)), v(random_direction(random));
        const vec3<float> turned = Turn<float>(from, vec3<float>(0) - from)(v);
        EXPECT_NEAR(length(turned), 1, 1e-5) << i;
        EXPECT_NEAR(dot(turned, from), -dot(v, from), 1e-5) << i;
        const vec3<float> to(random_direction(random));
        EXPECT_LT(length(Turn<float>(from, to)(from) - to), 1e-4f) << i;
    }
}

/// A step over where normals meet may throw a ray far out of the relief: it has left.
TEST(PrismFree, RaysThatAreThrownOutHaveLeft) {
    int left = 0;
    for (int seed = 0; seed < rounds(64); ++seed) {
        SphereRays rays(0.5f, grazing, Random(seed));
        Batch<float>& b = rays.batch;
        Random random(seed + 100);
        each(b, [&](int lane) {
            const dvec2 line(3, 2), across(2, -3);
            b.set(Value::dUVdx, lane, line * std::exp2(random.uniform(-12, 1)));
            b.set(Value::dUVdy, lane,
                  line * std::exp2(random.uniform(-12, 1)) +
                      across * std::exp2(random.uniform(-24, -6)));
        });
        b.run("prism-free", {{"steps", 4}});
        each(b, [&](int lane) {
            left += rays.status(lane) == Status::clip;
            if (rays.status(lane) == Status::clip) return;
            for (const Value v :
                 {Value::J, Value::T, Value::B, Value::frame_normal, Value::hit_depth})
                for (int c = 0; c < info(v).components; ++c)
                    EXPECT_LT(std::abs(b.real(v, lane, c)), 1e12f) << info(v).name;
        });
    }
    EXPECT_GT(left, 0);
}

/// Lanes without a frame and broken maps say so; without depth nothing moves.
TEST(CurvedRows, WhatCannotBeSearchedSaysSo) {
    for (const char* id : curved_rows) {
        SphereRays broken(std::numeric_limits<float>::quiet_NaN(), grazing, Random(3));
        broken.batch.run(id);
        EXPECT_EQ(broken.status(0), Status::nan) << id;
        SphereRays rays(0.5f, grazing, Random(3));
        rays.batch.integer(Value::frame_status, 5) = static_cast<int>(Status::no_frame);
        rays.batch.run(id);
        EXPECT_EQ(rays.status(5), Status::no_frame) << id;
        EXPECT_EQ(rays.batch.vector2(Value::hit_uv, 5), rays.batch.vector2(Value::uv, 5));
        EXPECT_EQ(rays.batch.real(Value::hit_depth, 5), 0);
        SphereOptions flat = grazing;
        flat.depth = 0;
        SphereRays none(0.5f, flat, Random(3));
        none.batch.run(id);
        each(none.batch, [&](int lane) {
            EXPECT_EQ(none.batch.real(Value::hit_depth, lane), 0) << id;
            EXPECT_EQ(none.batch.vector2(Value::hit_uv, lane), none.batch.vector2(Value::uv, lane));
        });
    }
}

/// Seen facets whose normal is turned away lie outside of the surface's outline: nothing is there
/// to be drawn. Normals towards the viewer without a frame are those of a damaged one.
TEST(CurvedRows, RaysPastTheOutlineMiss) {
    for (const char* id : curved_rows) {
        SphereRays rays(0.5f, grazing, Random(3));
        for (const int lane : {5, 6})
            rays.batch.integer(Value::frame_status, lane) = static_cast<int>(Status::no_frame);
        rays.batch.set(Value::frame_normal, 6, -dvec3(rays.batch.vector3(Value::frame_normal, 6)));
        rays.batch.run(id);
        EXPECT_EQ(rays.status(5), Status::no_frame) << id;
        EXPECT_EQ(rays.status(6), Status::clip) << id;
        EXPECT_EQ(rays.batch.real(Value::hit_depth, 6), 0) << id;
    }
}

}  // namespace
}  // namespace quadrel::test
