// Searches of relief over curved surfaces. Of a flat one they are plain relief mapping; over
// spheres they meet what is a constant depth below, and miss where a ray never comes so deep.
#include "effort.hpp"
#include "relief/curved/curved_rays.hpp"
#include "relief/exact/oracle.hpp"

namespace quadrel::test {
namespace {

using CurvedChange = std::function<void(Batch<float>&)>;

struct CurvedRow {
    std::string id;
    CurvedChange before{}, after{};

    void run(Batch<float>& batch, const Parameters& parameters = {}) const {
        if (before) before(batch);
        batch.run(id, parameters);
        if (after) after(batch);
    }
};

const char* const curved_rows[] = {"curved-quadric", "prism-free"};

void each(Batch<float>& batch, const std::function<void(int)>& change) {
    for (int lane = 0; lane < batch.lanes; ++lane) change(lane);
}

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

// ---- Of spheres ---------------------------------------------------------------------------------

/// Rays over spheres whose relief is of one height.
struct SphereRays {
    Map map;
    Batch<float> batch{64};
    Spheres spheres;
    double floor;  ///< world depth of the relief's surface below its top

    SphereRays(float height, const SphereOptions& options, Random random)
        : map(flat_map(height)),
          spheres(batch, random, options),
          floor((1 - double(height)) * options.depth) {
        batch.bind(TextureSlot::height, map.sampled);
        batch.material.seat = 1;
    }
    SphereRays(const SphereRays&) = delete;

    /// Distance from the fragment to what the row has found.
    double distance(int lane) {
        return double(batch.real(Value::hit_depth, lane)) / double(batch.real(Value::r, lane));
    }
    Status status(int lane) { return static_cast<Status>(batch.integer(Value::hit_status, lane)); }
};

/// How far the hits of a row are from the constant depth, the greatest in parts of the relief's
/// depth, and of uv in relief depths along the surface; rays that pass deeper by more than `band`
/// of the relief's depth are hit, and those that pass higher by as much are not.
struct SphereErrors {
    double depth = 0, uv = 0;
    int hits = 0, misses = 0, wrong = 0;
};

SphereErrors sphere_errors(const CurvedRow& row, int steps, double band,
                           const SphereOptions& options = {}) {
    SphereErrors errors;
    for (int seed = 0; seed < rounds(16); ++seed) {
        const float height = 0.1f + 0.2f * static_cast<float>(seed % 5);
        SphereRays rays(height, options, Random(static_cast<std::uint64_t>(seed) + 7));
        Batch<float> given = rays.batch;
        row.run(rays.batch, {{"steps", steps}, {"binary_steps", 20}});
        each(rays.batch, [&](int lane) {
            const SphereRay ray(given, lane, rays.spheres);
            const double D = options.depth;
            const double deepest = ray.side > 0 ? ray.depth_at(ray.turning()) : 1;
            const bool hit = rays.status(lane) == Status::hit;
            hit ? ++errors.hits : ++errors.misses;
            if (deepest > rays.floor + band * D) errors.wrong += !hit;
            if (deepest < rays.floor - band * D) errors.wrong += rays.status(lane) != Status::clip;
            if (!hit || deepest < rays.floor + band * D) return;
            const double t = rays.distance(lane);
            errors.depth = std::max(errors.depth, std::abs(ray.depth_at(t) - rays.floor) / D);
            const dvec2 uv(rays.batch.vector2(Value::hit_uv, lane));
            errors.uv = std::max(errors.uv, length(uv - ray.uv_at(t)) / D);
        });
    }
    return errors;
}

testing::AssertionResult meets_spheres(const CurvedRow& row, int steps, double depth_error,
                                       double uv_error, double band,
                                       const SphereOptions& options = {}) {
    const SphereErrors found = sphere_errors(row, steps, band, options);
    if (found.wrong == 0 && found.depth < depth_error && found.uv < uv_error &&
        found.hits > rounds(200) && (options.hollow || found.misses > rounds(50)))
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << row.id << ": depth " << found.depth << ", uv " << found.uv << ", wrong "
           << found.wrong << ", hits " << found.hits << ", misses " << found.misses;
}

constexpr SphereOptions grazing{.least_r = 0.05, .most_r = 0.6};

/// A ray that bends with the frame follows the sphere.
TEST(PrismFree, RaysBendAsSpheresDo) {
    EXPECT_TRUE(meets_spheres({"prism-free"}, 256, 0.005, 0.005, 0.02, grazing));
    SphereOptions hollow = grazing;
    hollow.hollow = true;
    EXPECT_TRUE(meets_spheres({"prism-free"}, 256, 0.005, 0.005, 0.02, hollow));
    const auto mirrored_normals = [](Batch<float>& b) {
        each(b, [&](int lane) {
            const dvec3 N(b.vector3(Value::frame_normal, lane));
            const dvec3 n(b.vector3(Value::vertex_normal, lane));
            b.set(Value::vertex_normal, lane, N * (2 * dot(N, n)) - n);
        });
    };
    const auto half_as_curved = [](Batch<float>& b) {
        each(b, [&](int lane) {
            const dvec3 N(b.vector3(Value::frame_normal, lane));
            const dvec3 n(b.vector3(Value::vertex_normal, lane));
            b.set(Value::vertex_normal, lane, N * dot(N, n) + n);
        });
    };
    const auto no_miss = [](Batch<float>& b) {
        each(b, [&](int lane) { b.integer(Value::hit_status, lane) = int(Status::hit); });
    };
    const auto flat_depth = [](Batch<float>& b) {
        each(b, [&](int lane) {
            b.real(Value::hit_depth, lane) = b.real(Value::hit_s, lane) * b.material.depth;
        });
    };
    EXPECT_FALSE(meets_spheres({"prism-free", mirrored_normals}, 256, 0.005, 0.005, 0.02, grazing));
    EXPECT_FALSE(meets_spheres({"prism-free", half_as_curved}, 256, 0.005, 0.005, 0.02, grazing));
    EXPECT_FALSE(meets_spheres({"prism-free", {}, no_miss}, 256, 0.005, 0.005, 0.02, grazing));
    EXPECT_FALSE(meets_spheres({"prism-free", {}, flat_depth}, 256, 0.005, 0.005, 0.02, grazing));
}

/// Where steps are twice as short errors are a quarter, down to what the quads leave, whose lanes
/// are beside the sphere.
TEST(PrismFree, ErrorsAreOfSecondOrderInTheStep) {
    double last = 0;
    for (const int steps : {4, 8, 16, 32}) {
        const SphereErrors found = sphere_errors({"prism-free"}, steps, 0.1, grazing);
        const double error = found.depth + found.uv;
        if (last > 0) {
            EXPECT_LT(error, std::max(0.4 * last, 2e-3)) << steps;
        }
        last = error;
    }
}

/// The quadric is right in the second order, in the directions of its two axes; UV lags behind the
/// sphere's.
TEST(CurvedQuadric, RaysBendAsQuadricsDo) {
    const SphereOptions shallow{.least_r = 0.01, .most_r = 0.12, .depth = 0.002};
    EXPECT_TRUE(meets_spheres({"curved-quadric"}, 256, 0.02, 2, 0.05, shallow));
    SphereOptions hollow = shallow;
    hollow.hollow = true;
    EXPECT_TRUE(meets_spheres({"curved-quadric"}, 256, 0.02, 2, 0.05, hollow));
    const auto scaled = [](double x, double y) {
        return [x, y](Batch<float>& b) {
            each(b, [&](int lane) {
                const dvec2 q(b.vector2(Value::quadric, lane));
                b.set(Value::quadric, lane, dvec2(q.x * x, q.y * y));
            });
        };
    };
    for (const auto& [x, y] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {-1.0, -1.0}, {0.5, 0.5}}) {
        const CurvedRow wrong{"curved-quadric", scaled(x, y)};
        EXPECT_FALSE(meets_spheres(wrong, 256, 0.02, 2, 0.05, shallow)) << x << " " << y;
    }
}

/// On the back of a mesh a sphere is hollow.
TEST(CurvedQuadric, BacksAreHollow) {
    const SphereOptions hollow{.least_r = 0.01, .most_r = 0.12, .depth = 0.002, .hollow = true};
    const auto as_back = [](bool turns_quadric) {
        return [turns_quadric](Batch<float>& b) {
            each(b, [&](int lane) {
                b.set(Value::vertex_normal, lane, -b.vector3(Value::vertex_normal, lane));
                if (turns_quadric) b.set(Value::quadric, lane, dvec2(0.5));
            });
        };
    };
    EXPECT_TRUE(meets_spheres({"curved-quadric", as_back(true)}, 256, 0.02, 2, 0.05, hollow));
    EXPECT_FALSE(meets_spheres({"curved-quadric", as_back(false)}, 256, 0.02, 2, 0.05, hollow));
    EXPECT_TRUE(meets_spheres({"prism-free", as_back(false)}, 256, 0.01, 0.01, 0.02, hollow));
}

/// How far the frame that hits are handed is from the sphere's at the displaced point: its normal,
/// and lengths of J, of which the sphere has more the deeper it is.
testing::AssertionResult turns_to_the_sphere(const CurvedRow& row, double tolerance,
                                             const SphereOptions& options, bool with_lengths) {
    int hits = 0;
    for (int seed = 0; seed < rounds(8); ++seed) {
        SphereRays rays(0.6f, options, Random(static_cast<std::uint64_t>(seed) + 31));
        Batch<float> given = rays.batch;
        row.run(rays.batch, {{"steps", 128}, {"binary_steps", 20}});
        for (int lane = 0; lane < rays.batch.lanes; ++lane) {
            if (rays.status(lane) != Status::hit) continue;
            ++hits;
            const SphereRay ray(given, lane, rays.spheres);
            const dvec3 hit = ray.P + ray.d * rays.distance(lane);
            const dvec3 expected = normalize(hit - ray.centre) * ray.side;
            const dvec3 N(rays.batch.vector3(Value::frame_normal, lane));
            const dvec3 T(rays.batch.vector3(Value::T, lane));
            const dvec3 J(rays.batch.vector3(Value::J, lane));
            const double full = options.density / (1 - rays.floor);
            const bool right = length(N - expected) < tolerance && std::abs(dot(N, T)) < 1e-5 &&
                               std::abs(length(T) - 1) < 1e-5 &&
                               std::abs(dot(N, J)) < 1e-5 * options.density &&
                               (!with_lengths || std::abs(length(J) - full) < 1e-3 * full);
            if (!right)
                return testing::AssertionFailure() << row.id << ": " << length(N - expected)
                                                   << ", J " << length(J) << " for " << full;
        }
    }
    return hits > rounds(100) ? testing::AssertionSuccess() : testing::AssertionFailure() << hits;
}

TEST(CurvedRows, HitsAreHandedTheFrameWhereTheyAre) {
    const SphereOptions shallow{.least_r = 0.1, .most_r = 0.5, .depth = 0.002};
    const auto straight = [](Batch<float>& b) {
        each(b, [&](int lane) {
            for (int c = 0; c < 3; ++c)
                b.real(Value::frame_normal, lane, c) = b.real(Value::vertex_normal, lane, c) / 0.7f;
        });
    };
    EXPECT_TRUE(turns_to_the_sphere({"prism-free"}, 3e-3, grazing, true));
    EXPECT_TRUE(turns_to_the_sphere({"curved-quadric"}, 3e-3, shallow, false));
    EXPECT_FALSE(turns_to_the_sphere({"prism-free", {}, straight}, 3e-3, grazing, true));
    EXPECT_FALSE(turns_to_the_sphere({"curved-quadric", {}, straight}, 3e-3, shallow, false));
}

/// Over a sphere of one height nothing is in the way of light: what is lit is what the sphere's own
/// horizon leaves, at the hit and not at the fragment.
testing::AssertionResult is_lit_to_the_horizon(const CurvedRow& row, const std::string& shadow,
                                               const SphereOptions& options) {
    int lit = 0, dark = 0;
    const int batches = sanitized ? 24 : 8;  // of fewer rays there
    for (int seed = 0; seed < batches; ++seed) {
        SphereRays rays(0.4f, options, Random(static_cast<std::uint64_t>(seed) + 55));
        Batch<float> given = rays.batch;
        row.run(rays.batch, {{"steps", 128}, {"binary_steps", 20}});
        rays.batch.run("displace");
        rays.batch.run(shadow);
        for (int lane = 0; lane < rays.batch.lanes; ++lane) {
            if (rays.status(lane) != Status::hit) continue;
            const SphereRay ray(given, lane, rays.spheres);
            const dvec3 hit(rays.batch.vector3(Value::hit_P, lane));
            const double above = dot(normalize(dvec3(10) - hit), normalize(hit - ray.centre));
            if (std::abs(above) < 0.02) continue;
            const bool is_lit = rays.batch.real(Value::shadow_visibility, lane) > 0;
            ++(is_lit ? lit : dark);
            if (is_lit != (above > 0))
                return testing::AssertionFailure() << row.id << ", " << shadow << ": " << above;
        }
    }
    if (lit < 2 * batches || dark < 2 * batches)
        return testing::AssertionFailure() << lit << " lit, " << dark << " dark";
    return testing::AssertionSuccess();
}

TEST(CurvedRows, HitsAreShadowedWhereTheyAre) {
    const auto straight = [](Batch<float>& b) {
        each(b, [&](int lane) {
            for (int c = 0; c < 3; ++c)
                b.real(Value::frame_normal, lane, c) = b.real(Value::vertex_normal, lane, c) / 0.7f;
        });
    };
    for (const char* shadow : {"shadow-exact", "shadow-march-thesis"}) {
        EXPECT_TRUE(is_lit_to_the_horizon({"prism-free"}, shadow, grazing));
        EXPECT_FALSE(is_lit_to_the_horizon({"prism-free", {}, straight}, shadow, grazing));
        EXPECT_TRUE(is_lit_to_the_horizon({"curved-quadric"}, shadow,
                                          {.least_r = 0.05, .most_r = 0.3, .depth = 0.002}));
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
