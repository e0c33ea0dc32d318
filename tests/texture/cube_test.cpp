// Cube maps: faces, edges, corners, gradients.
#include "quadrel/texture/cube.hpp"

#include "texture/planted.hpp"
#include "texture/support.hpp"

namespace quadrel::test {
namespace {

using Double = Quad<double>;
using Direction = vec3<double>;

vec3<Double> lanes(const Direction& d) { return {Double(d.x), Double(d.y), Double(d.z)}; }

struct Face {
    int face;
    double s, t;
    bool operator==(const Face&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Face& f) {
    return out << "face " << f.face << " (" << f.s << ", " << f.t << ")";
}

using Projection = std::function<Face(const Direction&)>;

Face project(const Direction& d) {
    const CubePoint<Double> at = project_to_cube(lanes(d));
    return {at.face.lane[0], first_lane(at.st.x), first_lane(at.st.y)};
}

testing::AssertionResult projects_as_specified(const Projection& projection) {
    const std::pair<Direction, Face> expected[] = {
        {{1, 0, 0}, {0, 0.5, 0.5}},       {{0.5, -0.25, 1}, {4, 0.75, 0.625}},
        {{-2, 0.5, 1}, {1, 0.75, 0.375}}, {{1, 1, 1}, {4, 1, 0}},
        {{-1, -1, 0}, {3, 0, 0.5}},       {{0, -1, 1}, {4, 0.5, 1}},
        {{0, 2, 0}, {2, 0.5, 0.5}},       {{0.5, 0, -2}, {5, 0.375, 0.5}},
    };
    for (const auto& [direction, want] : expected) {
        const Face got = projection(direction);
        if (!(got == want)) return testing::AssertionFailure() << got << ", want " << want;
    }
    return testing::AssertionSuccess();
}

TEST(Cube, Faces) {
    EXPECT_TRUE(projects_as_specified(project));
    EXPECT_FALSE(projects_as_specified([](Direction d) {  // Planted::ties_to_x
        d.x = std::nextafter(d.x, 10 * d.x);
        return project(d);
    }));
}

/// Direction through a point of a face, in the table's sense; st may lie outside of [0, 1].
Direction direction_of(int face, double s, double t) {
    const double a = 2 * s - 1, b = 2 * t - 1;
    switch (face) {
        case 0:
            return {1, -b, -a};
        case 1:
            return {-1, -b, a};
        case 2:
            return {a, 1, b};
        case 3:
            return {a, -1, -b};
        case 4:
            return {a, -b, 1};
        default:
            return {-a, -b, -1};
    }
}

using EdgeCrossing = std::function<std::array<int, 3>(std::array<int, 3> face_x_y, int size)>;

std::array<int, 3> cross(std::array<int, 3> from, int size) {
    const CubeTexel<Double> to =
        cross_edge<Double>({QuadInt(from[0]), QuadInt(from[1]), QuadInt(from[2])}, QuadInt(size));
    return {to.face.lane[0], to.x.lane[0], to.y.lane[0]};
}

/// The table agrees with geometry: just outside of a face, the direction through an edge texel's
/// centre column belongs to the neighbour's nearest texel.
testing::AssertionResult edges_meet(const EdgeCrossing& crossing) {
    constexpr int n = 8;
    for (int face = 0; face < 6; ++face) {
        for (int k = 0; k < n; ++k) {
            for (const auto [x, y] : {std::array{-1, k}, {n, k}, {k, -1}, {k, n}}) {
                const auto near = [](int i) {  // hardly beyond the edge
                    return i < 0 ? -1e-6 : i == n ? 1 + 1e-6 : (i + 0.5) / n;
                };
                const Face there = project(direction_of(face, near(x), near(y)));
                const std::array<int, 3> want = {there.face, static_cast<int>(there.s * n),
                                                 static_cast<int>(there.t * n)};
                if (crossing({face, x, y}, n) == want) continue;
                return testing::AssertionFailure() << face << " " << x << " " << y;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(Cube, Edges) {
    EXPECT_TRUE(edges_meet(cross));
    EXPECT_FALSE(edges_meet([](std::array<int, 3> from, int size) {  // Planted::clamped_edges
        const auto inside = [&](int i) { return std::min(std::max(i, 0), size - 1); };
        return std::array{from[0], inside(from[1]), inside(from[2])};
    }));
}

using CubeSampler = std::function<double(const SampledTexture&, const Direction&)>;

double sample_cube(const SampledTexture& t, const Direction& d) {
    return first_lane(texture_cube_lod(t, SampleContext<Double>{}, lanes(d), Double(0)).x);
}

/// Smooth over the whole cube: no jump across edges and corners.
testing::AssertionResult is_seamless(const CubeSampler& sampler) {
    RandomTexture texture(4, 4, 1, 6);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> along(-1, 1);
    for (int i = 0; i < 3000; ++i) {
        Direction d(along(random), along(random), along(random));
        // Near an edge between two faces, at times a corner.
        d[random() % 3] = 1;
        d[random() % 3] = -1;
        const double step = 1e-9;
        const double here = sampler(texture.sampled, d * (1 + step));
        d.x *= 1 + step;
        d.y *= 1 - step;
        const double there = sampler(texture.sampled, d);
        if (std::fabs(here - there) > 1e-6) return testing::AssertionFailure() << here - there;
    }
    return testing::AssertionSuccess();
}

double sample_clamped(const SampledTexture& t, const Direction& d) {
    const CubePoint<Double> at = project_to_cube(lanes(d));
    SampledTexture face = t;
    face.view.texels += at.face.lane[0] * t.view.width[0] * t.view.height[0];
    face.sampler.wrap_u = face.sampler.wrap_v = Wrap::clamp_to_edge;
    return sample_lod<Double>(face, first_lane(at.st.x), first_lane(at.st.y), 0).x;
}

TEST(Cube, Seamless) {
    EXPECT_TRUE(is_seamless(sample_cube));
    EXPECT_FALSE(is_seamless(sample_clamped));
}

testing::AssertionResult corner_is_mean_of_three(const CubeSampler& sampler) {
    RandomTexture texture(2, 2, 1, 6);
    std::fill(texture.texels.begin(), texture.texels.end(), 0.0f);
    const auto set = [&](int face, int x, int y, float value) {
        texture.texels[face * 4 + y * 2 + x] = value;
    };
    set(4, 1, 0, 3);  // +Z, +Y and +X meet at (1, 1, 1)
    set(2, 1, 1, 6);
    set(0, 0, 0, 9);
    const double got = sampler(texture.sampled, {1, 1, 1});
    if (std::fabs(got - 6) < 1e-12) return testing::AssertionSuccess();
    return testing::AssertionFailure() << got;
}

TEST(Cube, Corners) {
    EXPECT_TRUE(corner_is_mean_of_three(sample_cube));
    EXPECT_FALSE(corner_is_mean_of_three([](const SampledTexture& t, const Direction& d) {
        return sample_cube(t, d) + 0.25 * ((6 + 9) / 2.0 - 6);  // Planted::corner_of_two
    }));
}

using Derivative = std::function<vec2<double>(const Direction&, const Direction&)>;

vec2<double> derivative(const Direction& d, const Direction& dx) {
    const vec2<Double> st = cube_derivative(project_to_cube(lanes(d)), lanes(dx));
    return {first_lane(st.x), first_lane(st.y)};
}

/// The transformed derivative is the projection's own.
testing::AssertionResult derivative_is_of_projection(const Derivative& transform) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> along(-1, 1);
    for (int i = 0; i < 1000; ++i) {
        const Direction d(along(random), along(random), along(random));
        const Direction dx = Direction(along(random), along(random), along(random)) * 1e-6;
        const Face before = project(d - dx), after = project(d + dx);
        if (before.face != after.face || glm::length(d) < 0.3) continue;
        const vec2<double> want((after.s - before.s) / 2, (after.t - before.t) / 2);
        const vec2<double> got = transform(d, dx);
        if (glm::length(got - want) > 1e-4 * glm::length(dx)) {
            return testing::AssertionFailure() << got.x << " " << got.y;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Cube, Derivatives) {
    EXPECT_TRUE(derivative_is_of_projection(derivative));
    EXPECT_FALSE(derivative_is_of_projection([](const Direction& d, Direction dx) {
        int axis = 0;  // Planted::absolute_major
        for (int i = 1; i < 3; ++i) axis = std::fabs(d[i]) >= std::fabs(d[axis]) ? i : axis;
        dx[axis] = std::copysign(dx[axis], d[axis]);
        return derivative(d, dx);
    }));
}

TEST(Cube, Lod) {
    RandomTexture texture(256, 256, 1, 6);
    // On +Z, sc = x and tc = -y.
    const Direction d(0.25, 0.5, 1), dx(0.01, 0, 0.02);
    const auto st = derivative(d, dx);
    EXPECT_NEAR(st.x, 0.0025, 1e-15);
    EXPECT_NEAR(st.y, 0.005, 1e-15);
    LodRecord<Double> record;
    texture_cube_grad(texture.sampled, SampleContext<Double>{}, lanes(d), lanes(dx),
                      lanes({0, 0, 0}), &record);
    EXPECT_NEAR(first_lane(record.lambda), 0.5171078576689565, 1e-12);
    EXPECT_NEAR(first_lane(record.rho), 1.4310835, 1e-7);
}

TEST(Cube, NearestStaysOnTheFace) {
    RandomTexture texture(4, 4, 1, 6);
    SamplerState& s = texture.sampled.sampler;
    s.mag = s.min = Filter::nearest;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 16; ++i) {
            const Direction d = direction_of(face, (i % 4 + 0.5) / 4, (i / 4 + 0.5) / 4);
            EXPECT_EQ(sample_cube(texture.sampled, d), texture.texels[face * 16 + i]);
        }
    }
}

TEST(Cube, NullAndNanDirections) {
    RandomTexture texture(4, 4, 1, 6);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Direction d : {Direction(0, 0, 0), Direction(nan, 0, 1), Direction(1, infinity, nan),
                              Direction(infinity, 0, 0)}) {
        const double texel = sample_cube(texture.sampled, d);
        EXPECT_TRUE(texel >= 0 && texel <= 1);
    }
}

}  // namespace
}  // namespace quadrel::test
