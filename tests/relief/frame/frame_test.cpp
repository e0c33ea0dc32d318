// Frames against the exact Jacobian of the triangle, and against themselves under changes of camera
// and UV map.
#include "relief/frame/frame_support.hpp"

namespace quadrel::test {
namespace {

/// frame-gram, or a frame with an error.
Frame gram(Planted planted = Planted::none) {
    switch (planted) {
        case Planted::frame_of_the_listing:
            return {"frame-thesis"};
        case Planted::unsigned_area:
            return {"frame-gram", {}, [](Batch<float>& b) {
                        each_lane(b, [&](int lane) {
                            for (int c = 0; c < 3; ++c) b.real(Value::J, lane, c) *= -1;
                            b.real(Value::K, lane) *= -1;
                        });
                    }};
        case Planted::rate_without_angle:
            return {"frame-gram", {}, [](Batch<float>& b) {
                        each_lane(b, [&](int lane) {
                            for (int c = 0; c < 2; ++c) {
                                b.real(Value::K, lane, c) *= b.real(Value::r, lane);
                            }
                        });
                    }};
        case Planted::back_faces_kept:
            return {"frame-gram", [](Batch<float>& b) {
                        each_lane(b, [&](int lane) {
                            b.set(Value::Ng, lane, -b.vector3(Value::P, lane));
                        });
                    }};
        case Planted::frame_always_valid:
            return {"frame-gram", {}, [](Batch<float>& b) {
                        each_lane(b, [&](int lane) { b.integer(Value::frame_status, lane) = 1; });
                    }};
        case Planted::degenerate_unnoticed:
            return {"frame-gram", {}, [](Batch<float>& b) {
                        each_lane(b, [&](int lane) { b.integer(Value::frame_flags, lane) = 0; });
                    }};
        default:
            return {"frame-gram"};
    }
}

// ---- Exactness over triangles, helper lanes included --------------------------------------------

testing::AssertionResult exact_over_triangles(const Frame& frame, int triangles, double lean) {
    int compared = 0, helpers = 0;
    testing::AssertionResult result = testing::AssertionSuccess();
    each_lane_of_triangles(
        frame, {}, triangles, lean,
        [&](Batch<float>& batch, int lane, const FrameInputs& inputs, const Triangle&) {
            const FrameTruth truth = exact_frame(inputs);
            if (!result || !truth.meaningful || truth.r < 0.01) return;
            ++compared;
            const float first = batch.edges[0][lane];
            helpers += first * batch.edges[1][lane] < 0 || first * batch.edges[2][lane] < 0;
            result = frame_within_bounds(batch, lane, truth);
        });
    if (!result) return result;
    const bool enough = compared > 40 * triangles && helpers > triangles;
    return enough ? testing::AssertionSuccess()
                  : testing::AssertionFailure() << compared << " lanes, " << helpers << " helpers";
}

TEST(FrameGram, IsExactOverTriangles) {
    EXPECT_TRUE(exact_over_triangles(gram(), 400, 0));
    EXPECT_TRUE(exact_over_triangles(gram(), 400, 0.3));
}

TEST(FrameGram, ErrorsAreCaughtOverTriangles) {
    for (const Planted planted :
         {Planted::frame_of_the_listing, Planted::unsigned_area, Planted::rate_without_angle}) {
        EXPECT_FALSE(exact_over_triangles(gram(planted), 5, 0)) << static_cast<int>(planted);
    }
}

// ---- Invariance ---------------------------------------------------------------------------------

TEST(FrameGram, ShiftIsInvariant) {
    for (const PlaneChange& change : {camera_roll, mirrored_u, sheared, anisotropic}) {
        EXPECT_EQ(unchanged_part(gram(), change, random_plane, 1000), 1) << change.name;
    }
}

/// The listing's K turns with the camera, and its error is the angle between the tangents; a UV map
/// alone changes qx and qy linearly, so mirroring, shear and scale of UV do not show it.
TEST(FrameThesis, ShiftTurnsWithTheCamera) {
    EXPECT_LT(unchanged_part({"frame-thesis"}, camera_roll, random_plane, 1000), 0.05);
}

TEST(FrameGram, ErrorsAreCaughtByInvariance) {
    EXPECT_LT(unchanged_part(gram(Planted::frame_of_the_listing), camera_roll, random_plane, 100),
              0.5);
}

// ---- The error of the listed frame --------------------------------------------------------------

/// Coefficients of `rate` in the basis (dUV/dT, dUV/dB).
dvec2 coefficients(const dvec2& rate, const dvec2& per_T, const dvec2& per_B) {
    const double det = per_T.x * per_B.y - per_T.y * per_B.x;
    return dvec2(rate.x * per_B.y - rate.y * per_B.x, per_T.x * rate.y - per_T.y * rate.x) / det;
}

/// |error| / |(a, b)| of the frame's coefficients along the unit tangents, beside |cos(T, B)|.
struct CoefficientError {
    double relative, cosine;
};

CoefficientError coefficient_error(const Frame& frame, const Plane& plane) {
    const std::array<dvec3, 4> P = quad_points(plane);
    const dvec3 px = P[1] - P[0], py = P[2] - P[0];
    const ExactJacobian J =
        ExactJacobian::from_edges(plane.dPdu, plane.dPdv, dvec2(1, 0), dvec2(0, 1));
    const dvec3 V = normalize(-P[0]);
    const dvec2 exact = J * -V / dot(V, plane.normal);
    const dvec2 per_T = J * px / length(px), per_B = J * py / length(py);
    const dvec2 truth = coefficients(exact, per_T, per_B);
    const dvec2 computed = coefficients(shift_over(frame, plane).K, per_T, per_B);
    return {length(computed - truth) / length(truth),
            std::abs(dot(px, py)) / (length(px) * length(py))};
}

/// Relative error in coefficient space equals |cos(T, B)|, up to rounding.
testing::AssertionResult error_is_the_cosine(const Frame& frame) {
    Random random(11);
    for (int i = 0; i < 2000;) {
        Plane plane = random_plane(random);
        plane.uv0 = dvec2(0);
        if (dot(plane.normal, normalize(-plane.origin)) < 0.3) continue;
        ++i;
        const CoefficientError e = coefficient_error(frame, plane);
        if (std::abs(e.relative - e.cosine) <= 0.01) continue;
        return testing::AssertionFailure() << e.relative << " for a cosine of " << e.cosine;
    }
    return testing::AssertionSuccess();
}

TEST(FrameThesis, ErrorIsTheCosineOfItsTangents) {
    EXPECT_TRUE(error_is_the_cosine({"frame-thesis"}));
    EXPECT_FALSE(error_is_the_cosine(gram()));
}

/// Tilted about a window axis and seen on it, px and py are perpendicular.
TEST(FrameThesis, IsExactForPerpendicularTangents) {
    for (const double tilt : {0.25, 0.5, 1.0}) {
        Plane plane;
        plane.origin = dvec3(0, 0, -2);
        plane.normal = normalize(dvec3(tilt, 0, 1));
        plane.dPdu = in_plane(plane.normal, dvec3(0, 1, 0), 1, 0.4);
        plane.dPdv = in_plane(plane.normal, dvec3(0, 1, 0), 0.3, -2);
        plane.uv0 = dvec2(0);
        const CoefficientError e = coefficient_error({"frame-thesis"}, plane);
        EXPECT_LT(e.relative, 1e-3) << tilt;
        EXPECT_LT(e.cosine, 1e-9) << tilt;
    }
}

// ---- Status, flags, facing ----------------------------------------------------------------------

/// One quad with the given window differences, in every quad of a batch of 16 lanes.
Batch<float> quad_of(const dvec3& px, const dvec3& py, const dvec2& qx, const dvec2& qy,
                     const dvec3& normal, const dvec3& face_normal) {
    Batch<float> batch(16);
    batch.material.depth = 0.5f;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::P, lane, vec3<float>(0.1f, 0.2f, -2));
        batch.set(Value::vertex_normal, lane, normal);
        batch.set(Value::Ng, lane, face_normal);
        batch.set(Value::dPdx, lane, px);
        batch.set(Value::dPdy, lane, py);
        batch.set(Value::dUVdx, lane, qx);
        batch.set(Value::dUVdy, lane, qy);
    }
    return batch;
}

testing::AssertionResult is_no_frame(const Frame& frame, const dvec3& px, const dvec3& py,
                                     const dvec3& normal, const dvec3& face_normal) {
    Batch<float> batch = quad_of(px, py, u_step, v_step, normal, face_normal);
    frame.run(batch);
    const bool marked = batch.integer(Value::frame_status, 0) == static_cast<int>(Status::no_frame);
    const bool still = batch.real(Value::K, 0, 0) == 0 && batch.real(Value::K, 0, 1) == 0;
    const bool harmless = batch.real(Value::r, 0) == 1;  // displacement divides by it
    if (marked && still && harmless) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "status " << batch.integer(Value::frame_status, 0)
                                       << ", K.x " << batch.real(Value::K, 0, 0);
}

/// Every way not to have a frame: no area, parallel steps, not a number, and a vertex normal that
/// looks away from a viewer who sees the front.
testing::AssertionResult degenerate_quads_have_no_frame(const Frame& frame) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const dvec3 pairs[][2] = {
        {right_step, right_step},   {right_step, right_step * -3.0},
        {dvec3(0), up_step},        {right_step, dvec3(0)},
        {dvec3(0), dvec3(0)},       {right_step, right_step + dvec3(0, 1e-9, 0)},
        {dvec3(nan, 0, 0), up_step}};
    for (const auto& [px, py] : pairs) {
        const auto result = is_no_frame(frame, px, py, front, front);
        if (!result) return result;
    }
    return is_no_frame(frame, right_step, up_step, -front, front);
}

TEST(FrameGram, DegenerateQuadsHaveNoFrame) {
    EXPECT_TRUE(degenerate_quads_have_no_frame(gram()));
    EXPECT_FALSE(degenerate_quads_have_no_frame(gram(Planted::frame_always_valid)));
}

/// The limit of 8 eps on the sine of the angle between the steps, from both sides.
TEST(FrameGram, NearlyParallelStepsKeepTheirFrame) {
    const double eps = std::numeric_limits<float>::epsilon();
    const auto beside = [&](double factor) {
        return right_step + dvec3(0, right_step.x * factor * eps, 0);
    };
    EXPECT_TRUE(is_no_frame(gram(), right_step, beside(6), front, front));
    EXPECT_FALSE(is_no_frame(gram(), right_step, beside(10), front, front));
}

/// J of rank 2 is not flagged; rank 1 and 0 are, are rendered, and have finite K.
testing::AssertionResult flat_uv_maps_are_flagged(const Frame& frame) {
    const dvec2 maps[][2] = {{u_step, v_step},
                             {u_step, u_step * 0.7},
                             {dvec2(0), v_step},
                             {u_step, dvec2(0)},
                             {dvec2(0), dvec2(0)}};
    for (const auto& [qx, qy] : maps) {
        Batch<float> batch = quad_of(right_step, up_step, qx, qy, front, front);
        frame.run(batch);
        const bool regular = qx == u_step && qy == v_step;
        const int flags = batch.integer(Value::frame_flags, 0);
        const bool flagged = (flags & HitFlag::uv_degenerate) != 0;
        const bool rendered =
            batch.integer(Value::frame_status, 0) == static_cast<int>(Status::hit);
        const bool finite = is_finite(batch.real(Value::K, 0, 0) + batch.real(Value::K, 0, 1));
        if (flagged == regular || !rendered || !finite) {
            return testing::AssertionFailure() << "qx.x " << qx.x << ", qy.x " << qy.x;
        }
    }
    return testing::AssertionSuccess();
}

TEST(FrameGram, DegenerateUvMapsAreFlagged) {
    EXPECT_TRUE(flat_uv_maps_are_flagged(gram()));
    EXPECT_FALSE(flat_uv_maps_are_flagged(gram(Planted::degenerate_unnoticed)));
}

/// Seen from behind, normals flip and everything else is that of the front.
testing::AssertionResult back_faces_flip(const Frame& frame) {
    Batch<float> from_front = quad_of(right_step, up_step, u_step, v_step, front, front);
    Batch<float> from_back = quad_of(right_step, up_step, u_step, v_step, -front, -front);
    frame.run(from_front);
    frame.run(from_back);
    constexpr auto compared = values(Value::frame_normal, Value::J, Value::r, Value::uv_rate,
                                     Value::K, Value::frame_status, Value::frame_flags);
    return same_bits<float>(from_front, from_back, compared);
}

TEST(FrameGram, BackFacesFlipTheNormal) {
    EXPECT_TRUE(back_faces_flip(gram()));
    EXPECT_FALSE(back_faces_flip(gram(Planted::back_faces_kept)));
}

}  // namespace
}  // namespace quadrel::test
