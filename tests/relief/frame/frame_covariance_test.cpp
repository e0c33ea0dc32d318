// What every frame does when the camera rolls or the UV map is mirrored, sheared or stretched:
// which shifts follow, and which do not. Frames that take their tangents from the vertices.
#include "relief/frame/frame_support.hpp"

namespace quadrel::test {
namespace {

// ---- Changes of camera and map ------------------------------------------------------------------

/// For each change whether K follows: from planes of sheared tiles, or of square ones.
struct Covariance {
    const char* id;
    Plane (*plane)(Random&);
    bool roll, mirror, shear, anisotropy;
};

constexpr Covariance covariances[] = {
    {"frame-face", random_plane, true, true, true, true},
    {"frame-gram", random_plane, true, true, true, true},
    {"frame-cot", random_plane, true, true, true, true},
    {"frame-inverse-tbn", random_plane, true, true, true, true},
    // Right for square tiles, and for oblong ones thanks to the density; not for rhombs.
    {"frame-vertex", random_square_plane, true, true, false, true},
    {"frame-mikkt", random_square_plane, true, true, false, true},
    // Its unit is the tile along the longest gradient, which shear changes.
    {"frame-cot@published", random_square_plane, true, true, false, true},
    {"frame-inverse-tbn@published", random_square_plane, true, true, false, false},
    // The error of the thesis' frame is the angle between its tangents, which the camera decides;
    // to a change of the UV map qx and qy are linear, and so is K.
    {"frame-thesis", random_square_plane, false, true, true, true},
};

testing::AssertionResult follows(const Frame& frame, const PlaneChange& change,
                                 Plane (*plane)(Random&), bool expected) {
    const double part = unchanged_part(frame, change, plane, 150);
    if (expected ? part == 1 : part < 0.05) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << frame.id << " " << (expected ? "does not follow" : "follows") << " " << change.name
           << ": " << part;
}

TEST(Frames, FollowTheCameraAndTheMapOrDoNot) {
    for (const Covariance& row : covariances) {
        EXPECT_TRUE(follows({row.id}, camera_roll, row.plane, row.roll));
        EXPECT_TRUE(follows({row.id}, mirrored_u, row.plane, row.mirror));
        EXPECT_TRUE(follows({row.id}, sheared, row.plane, row.shear));
        EXPECT_TRUE(follows({row.id}, anisotropic, row.plane, row.anisotropy));
    }
    const Frame without_sign{"frame-cot", {}, [](Batch<float>& b) {
                                 each_lane(b, [&](int lane) {
                                     float& K = b.real(Value::K, lane);
                                     K = std::abs(K);
                                 });
                             }};
    EXPECT_FALSE(follows(without_sign, mirrored_u, random_plane, true));
}

/// Unit axes where the tiles are squares: then the published shift is the exact one, with the depth
/// in tiles.
TEST(PublishedFrames, AreRightForSquareTiles) {
    for (const char* id : {"frame-cot@published", "frame-inverse-tbn@published"}) {
        Random random(9);
        for (int i = 0; i < 100; ++i) {
            const Plane plane = random_square_plane(random);
            const PlaneShift listed = shift_over({id}, plane),
                             exact = shift_over({"frame-cot"}, plane);
            if (!exact.meaningful) continue;
            const dvec2 in_tiles = exact.K * length(plane.dPdu);
            EXPECT_LT(length(listed.K - in_tiles), 0.02 * length(in_tiles) + 1e-4)
                << id << " " << i;
        }
    }
}

/// |grad v| = 4 |grad u|, seen along the diagonal: (0.1, 0.4) is right.
TEST(FrameInverseTbnPublished, InvertsAnisotropy) {
    Plane plane;
    plane.origin = dvec3(0, 0, -2);
    plane.normal = normalize(dvec3(0.5, 0.5, 1));
    plane.dPdu = normalize(cross(dvec3(0, 1, 0), plane.normal));
    plane.dPdv = cross(plane.normal, plane.dPdu) * 0.25;
    plane.uv0 = dvec2(0);
    const dvec2 listed = shift_over({"frame-inverse-tbn@published"}, plane).K;
    const dvec2 right = shift_over({"frame-inverse-tbn"}, plane).K;
    const double ratio = std::abs(listed.x / listed.y) / std::abs(right.x / right.y);
    EXPECT_NEAR(ratio, 16, 0.1);
}

// ---- Tangents of vertices
// ---------------------------------------------------------------------------------

/// nx T + ny B + nz N of the frame points where that sum of the interpolated, not normalised,
/// vectors does.
TEST(FrameMikkt, PerturbsNormalsAsPrescribed) {
    Random random(21);
    for (int i = 0; i < 200; ++i) {
        const Plane plane = random_plane(random);
        const dvec3 N = (plane.normal + random_direction(random) * 0.2) * random.uniform(0.6, 1);
        const dvec3 T = cross(N, random_direction(random)) * random.uniform(0.6, 1);
        const double sign = random.chance(0.5) ? 1 : -1;
        Batch<float> batch(16);
        batch.material.depth = 0.1f;
        each_lane(batch, [&](int lane) {
            batch.set(Value::P, lane, plane.origin);
            batch.set(Value::Ng, lane, plane.normal);
            batch.set(Value::vertex_normal, lane, N * 3.0);  // a scaled object's
            set_plane_frame(batch, lane, plane);
            batch.set(Value::vertex_tangent, lane, T);
            batch.set(Value::vertex_bitangent, lane, N);
            batch.real(Value::tangent_sign, lane) = static_cast<float>(sign);
        });
        batch.run("frame-mikkt");
        const dvec3 n(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.2, 1));
        const dvec3 prescribed = normalize(T * n.x + cross(N, T) * (sign * n.y) + N * n.z);
        const dvec3 by_frame = normalize(dvec3(batch.vector3(Value::T, 0)) * n.x +
                                         dvec3(batch.vector3(Value::B, 0)) * n.y +
                                         dvec3(batch.vector3(Value::frame_normal, 0)) * n.z);
        EXPECT_LT(length(prescribed - by_frame), 1e-5);
    }
}

/// Vertices without tangents, as a mesh of a degenerate map has them: K = 0, rendered, flagged.
TEST(VertexFrames, VerticesWithoutTangentsDoNotShift) {
    for (const char* id : {"frame-vertex", "frame-mikkt"}) {
        Batch<float> batch(16);
        batch.material.depth = 0.5f;
        each_lane(batch, [&](int lane) {
            batch.set(Value::P, lane, dvec3(0.1, 0.2, -2));
            batch.set(Value::vertex_normal, lane, dvec3(0, -0.2, 1));
            batch.set(Value::Ng, lane, normalize(dvec3(0, -0.2, 1)));
            for (int c = 0; c < 6; ++c) batch.real(Value::face_J, lane, c) = 0;
            batch.set(Value::vertex_tangent, lane, dvec3(0));
            batch.set(Value::vertex_bitangent, lane, dvec3(0));
            batch.real(Value::tangent_sign, lane) = 0;
        });
        batch.run(id);
        EXPECT_EQ(batch.integer(Value::frame_status, 0), static_cast<int>(Status::hit)) << id;
        EXPECT_EQ(batch.integer(Value::frame_flags, 0), HitFlag::uv_degenerate) << id;
        EXPECT_EQ(batch.vector2(Value::K, 0), vec2<float>(0, 0)) << id;
    }
}

}  // namespace
}  // namespace quadrel::test
