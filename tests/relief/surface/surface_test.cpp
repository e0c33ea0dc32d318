// Normals from heights against the geometry of the displaced plane.
#include "relief/facet.hpp"
#include "relief/planted.hpp"
#include "relief/surface/normal_error.hpp"

namespace quadrel::test {
namespace {

using Surface = StageUnderTest<float>;

void change_normals(Batch<float>& batch,
                    const std::function<dvec3(const dvec3& n, const dvec3& N)>& change) {
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const dvec3 n(batch.vector3(Value::N, lane));
        batch.set(Value::N, lane, change(n, dvec3(batch.vector3(Value::frame_normal, lane))));
    }
}

Surface h2n(Planted planted = Planted::none) {
    switch (planted) {
        case Planted::slope_upside_down:
            return {"h2n-thesis", [](Batch<float>& b) { b.material.depth *= -1; },
                    [](Batch<float>& b) { b.material.depth *= -1; }};
        case Planted::relief_without_base:
            return {"h2n-thesis", [](Batch<float>& b) {
                        for (int lane = 0; lane < b.lanes; ++lane) {
                            b.set(Value::frame_normal, lane, b.vector3(Value::Ng, lane));
                        }
                    }};
        case Planted::unnormalised_sum:
            return {"h2n-thesis", {}, [](Batch<float>& b) {
                        change_normals(b, [](const dvec3& n, const dvec3&) { return n * 1.0001; });
                    }};
        default:
            return {"h2n-thesis"};
    }
}

/// Rounding of two normalised sums, and of height differences over `size` texels a unit.
double normal_bound(const Plane& plane, float depth, int size) {
    const auto J = ExactJacobian::from_edges(plane.dPdu, plane.dPdv, dvec2(1, 0), dvec2(0, 1));
    const double gradient = length(J.grad_u) + length(J.grad_v);
    return float_roundoff * (32 + 4 * static_cast<double>(depth) * gradient * size);
}

/// The unit normal of the plane displaced by heights of the given slopes: P(u, v) + depth h N.
dvec3 displaced_normal(const Plane& plane, float depth, const dvec2& slope) {
    const double D = depth;
    const dvec3 n =
        cross(plane.dPdu + plane.normal * (D * slope.x), plane.dPdv + plane.normal * (D * slope.y));
    return normalize(dot(n, plane.normal) < 0 ? -n : n);
}

/// n = normalize(m + (N - Nf)), m the normal of the displaced face.
testing::AssertionResult normals_over(const Surface& surface, const Map& map, const dvec2& slope,
                                      double lean) {
    for (int i = 0; i < 200; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Plane plane = random_plane(random);
        const dvec3 N = leaning(plane, random, lean);
        const float depth = static_cast<float>(random.uniform(0.01, 0.5));
        Batch<float> batch = facet_batch(plane, N, depth, random);
        batch.bind(TextureSlot::height, map.sampled);
        surface.run(batch);
        const dvec3 m = displaced_normal(plane, depth, slope);
        const double error = largest_error(batch, normalize(m + (N - plane.normal)));
        const double bound = normal_bound(plane, depth, map.sampled.view.width[0]);
        if (!(error <= bound)) {
            return testing::AssertionFailure() << "error " << error << ", bound " << bound;
        }
    }
    return testing::AssertionSuccess();
}

/// Linear where the lanes look: dh/du = 1/2, dh/dv = -1/4.
Map ramp() {
    return height_map(32, 32, [](int x, int y) {
        return static_cast<float>(x) / 64 + 0.5f - static_cast<float>(y) / 128;
    });
}
const dvec2 ramp_slope(0.5, -0.25);

TEST(H2nThesis, FlatMapsGiveTheFramesNormal) {
    EXPECT_TRUE(normals_over(h2n(), flat_map(0.4f), dvec2(0), 0));
    EXPECT_TRUE(normals_over(h2n(), flat_map(0.4f), dvec2(0), 0.4));
    EXPECT_FALSE(normals_over(h2n(Planted::unnormalised_sum), flat_map(0.4f), dvec2(0), 0));
}

TEST(H2nThesis, RampsGiveTheDisplacedPlane) {
    EXPECT_TRUE(normals_over(h2n(), ramp(), ramp_slope, 0));
    EXPECT_FALSE(normals_over(h2n(Planted::slope_upside_down), ramp(), ramp_slope, 0));
}

TEST(H2nThesis, SmoothShadingAddsItsDifference) {
    EXPECT_TRUE(normals_over(h2n(), ramp(), ramp_slope, 0.4));
    EXPECT_FALSE(normals_over(h2n(Planted::relief_without_base), ramp(), ramp_slope, 0.4));
}

/// Depth 0, and lanes without a frame: the frame's normal, bit for bit.
testing::AssertionResult leaves_the_frames_normal(const Surface& surface, float depth,
                                                  Status status) {
    Random random(3);
    const Map map = noise_map(random, 16, 16);
    const Plane plane = random_plane(random);
    Batch<float> batch = facet_batch(plane, leaning(plane, random, 0.3), depth, random);
    batch.bind(TextureSlot::height, map.sampled);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.integer(Value::frame_status, lane) = static_cast<int>(status);
    }
    surface.run(batch);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (batch.vector3(Value::N, lane) != batch.vector3(Value::frame_normal, lane)) {
            return testing::AssertionFailure() << "lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(H2nThesis, WithoutDepthOrFrameNothingTilts) {
    EXPECT_TRUE(leaves_the_frames_normal(h2n(), 0, Status::hit));
    EXPECT_TRUE(leaves_the_frames_normal(h2n(), 0.3f, Status::no_frame));
    EXPECT_FALSE(leaves_the_frames_normal(h2n(Planted::unnormalised_sum), 0, Status::hit));
    EXPECT_TRUE(leaves_the_frames_normal({"surface-none"}, 0.3f, Status::hit));
}

/// The same surface by a map mirrored in u: grad u and uv mirrored with it.
testing::AssertionResult mirrored_maps_agree(const Surface& surface) {
    Random random(4), texels(5), again(5);
    const Map map = noise_map(texels, 16, 16);
    std::vector<float> rows;
    for (int i = 0; i < 256; ++i) rows.push_back(static_cast<float>(again.uniform(0, 1)));
    const Map mirror = height_map(
        16, 16, [&](int x, int y) { return rows[static_cast<std::size_t>(16 * y + 15 - x)]; });
    const Plane plane = random_plane(random);
    Batch<float> one = facet_batch(plane, leaning(plane, random, 0.2), 0.1f, random);
    Batch<float> other = one;
    one.bind(TextureSlot::height, map.sampled);
    other.bind(TextureSlot::height, mirror.sampled);
    for (int lane = 0; lane < one.lanes; ++lane) {
        for (int c = 0; c < 3; ++c) other.real(Value::J, lane, c) *= -1;
        other.real(Value::hit_uv, lane) = 1 - one.real(Value::hit_uv, lane);
    }
    one.run("h2n-thesis");
    surface.run(other);
    for (int lane = 0; lane < one.lanes; ++lane) {
        const auto difference = one.vector3(Value::N, lane) - other.vector3(Value::N, lane);
        if (length(difference) > 2e-4f) return testing::AssertionFailure() << "lane " << lane;
    }
    return testing::AssertionSuccess();
}

TEST(H2nThesis, MirroredMapsAgree) {
    EXPECT_TRUE(mirrored_maps_agree(h2n()));
    EXPECT_FALSE(mirrored_maps_agree(h2n(Planted::slope_upside_down)));
}

/// A face seen from behind has the normals of its front.
TEST(H2nThesis, BackFacesAgree) {
    Random random(6);
    const Map map = noise_map(random, 16, 16);
    const Plane plane = random_plane(random);
    Batch<float> front = facet_batch(plane, leaning(plane, random, 0.2), 0.1f, random);
    front.bind(TextureSlot::height, map.sampled);
    Batch<float> back = front;
    for (int lane = 0; lane < back.lanes; ++lane) back.set(Value::Ng, lane, -plane.normal);
    front.run("h2n-thesis");
    back.run("h2n-thesis");
    constexpr auto normals = values(Value::N);
    EXPECT_TRUE(same_bits<float>(front, back, normals));
}

/// Over a flat map and a flat face the published normal is the face's, in either window
/// orientation.
TEST(H2nThesisPublished, FlatMapsGiveTheFaceNormal) {
    Random random(7);
    const Map map = flat_map(0.75f);
    Batch<float> batch;
    fill_quads(batch, random, 0);
    batch.material.depth = 0.2f;
    batch.bind(TextureSlot::height, map.sampled);
    for (const char* id : {"differentiate", "frame-thesis", "linear-thesis"}) batch.run(id);
    batch.run("h2n-thesis@published");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const auto N = batch.vector3(Value::frame_normal, lane);
        EXPECT_LT(length(batch.vector3(Value::N, lane) - N), 0.01f);
    }
}

}  // namespace
}  // namespace quadrel::test
