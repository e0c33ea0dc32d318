// Over spheres searches of curved relief meet what is a constant depth below, and miss where a ray
// never comes so deep; what hits are handed is the sphere's.
#include "effort.hpp"
#include "relief/curved/curved_rows.hpp"

namespace quadrel::test {
namespace {

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

}  // namespace
}  // namespace quadrel::test
