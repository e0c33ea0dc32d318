// The frames that claim to be exact, against the exact frame of the triangle; degenerate maps and
// quads.
#include "relief/frame/frame_support.hpp"

namespace quadrel::test {
namespace {

constexpr double oblique = 1;

/// A frame that is exact, by which split.
struct ExactRow {
    Frame frame;
    Parameters parameters;
    bool oblique = false;
    bool from_vertices = false;  ///< J from the triangle's vertices
    bool from_steps = false;     ///< the face normal too from window differences
};

ExactRow face(bool split = false) {
    return {{"frame-face"}, {{"split", split ? oblique : 0}}, split, true};
}
ExactRow gram(bool split) { return {{"frame-gram"}, {{"split", split ? oblique : 0}}, split}; }
ExactRow cot() { return {{"frame-cot"}, {}, true}; }
ExactRow inverse_tbn() { return {{"frame-inverse-tbn"}, {}, true, false, true}; }

/// frame-cot with an error.
ExactRow flawed(Planted planted) {
    ExactRow row = cot();
    row.frame.after = [planted](Batch<float>& b) {
        each_lane(b, [&](int lane) {
            const float r = b.real(Value::r, lane);
            const auto N = b.vector3(Value::frame_normal, lane);
            const float along_N = dot(normalize(-b.vector3(Value::P, lane)), N);
            for (int c = 0; c < 2; ++c) {
                float& K = b.real(Value::K, lane, c);
                if (planted == Planted::rate_without_angle) K *= r;
                if (planted == Planted::rate_along_the_normal) K *= r / along_N;
                if (planted == Planted::unsigned_area) K = -K;
            }
            if (planted == Planted::degenerate_unnoticed) b.integer(Value::frame_flags, lane) = 0;
            if (planted == Planted::frame_always_valid) b.integer(Value::frame_status, lane) = 1;
        });
    };
    return row;
}

// ---- Exactness over triangles, helper lanes included --------------------------------------------

testing::AssertionResult exact_over_triangles(const ExactRow& row, int triangles, double lean) {
    int compared = 0;
    testing::AssertionResult result = testing::AssertionSuccess();
    each_lane_of_triangles(
        row.frame, row.parameters, triangles, lean,
        [&](Batch<float>& batch, int lane, const FrameInputs& inputs, const Triangle& t) {
            if (!result) return;
            const FrameInputs in = row.from_vertices ? vertex_inputs(inputs) : inputs;
            FrameTruth truth = row.oblique
                                   ? exact_oblique_frame(in, t.face_normal(), row.from_steps)
                                   : exact_frame(in);
            if (!truth.meaningful || truth.r < 0.01) return;
            ++compared;
            result = frame_within_bounds(batch, lane, truth);
        });
    if (!result) return result;
    return compared > 40 * triangles ? testing::AssertionSuccess()
                                     : testing::AssertionFailure() << compared << " lanes";
}

TEST(ExactFrames, AreExactOverTriangles) {
    for (const ExactRow& row :
         {face(), face(true), gram(false), gram(true), cot(), inverse_tbn()}) {
        EXPECT_TRUE(exact_over_triangles(row, 150, 0)) << row.frame.id;
        EXPECT_TRUE(exact_over_triangles(row, 150, 0.3)) << row.frame.id << " " << row.oblique;
    }
}

TEST(ExactFrames, ErrorsAreCaughtOverTriangles) {
    for (const Planted planted :
         {Planted::rate_without_angle, Planted::rate_along_the_normal, Planted::unsigned_area})
        EXPECT_FALSE(exact_over_triangles(flawed(planted), 5, 0.3)) << static_cast<int>(planted);
    ExactRow other_split = gram(true);
    other_split.oblique = false;
    EXPECT_FALSE(exact_over_triangles(other_split, 5, 0.3));
}

/// What is judged by the window's differences may be off by their rounding, the judge may not.
TEST(FrameFace, IsFarMoreExactThanDerivatives) {
    double worst_face = 0, worst_gram = 0;
    for (auto [id, worst] : {std::pair{"frame-face", &worst_face}, {"frame-gram", &worst_gram}}) {
        each_lane_of_triangles(
            {id}, {}, 50, 0,
            [&](Batch<float>& batch, int lane, const FrameInputs& in, const Triangle&) {
                const dvec3 off = dvec3(batch.vector3(Value::J, lane)) - in.J.grad_u;
                *worst = std::max(*worst, length(off) / length(in.J.grad_u));
            });
    }
    EXPECT_LT(worst_face, 1e-6);
    EXPECT_GT(worst_gram, 100 * worst_face);
}

/// With the face's own normal there is nothing to split: the frames agree, up to their bounds.
TEST(FrameCot, EqualsFrameGramOnFlatFaces) {
    const auto worst_difference = [](double lean) {
        double worst = 0;
        Random random(3);
        for (int i = 0; i < 40; ++i) {
            Batch<float> a(64);
            a.material.depth = 0.5f;
            for (int quad = 0; quad < 16; ++quad)
                fill_quad(a, quad, random_plane(random), random, lean);
            a.run("differentiate");
            Batch<float> b = a;
            a.run("frame-gram");
            b.run("frame-cot");
            each_lane(a, [&](int lane) {
                if (a.real(Value::r, lane) < 0.1f) return;
                const dvec2 K(a.vector2(Value::K, lane)), other(b.vector2(Value::K, lane));
                worst = std::max(worst, length(K - other) / length(K));
            });
        }
        return worst;
    };
    EXPECT_LT(worst_difference(0), 0.02);
    EXPECT_GT(worst_difference(0.3), 0.1);
}

// ---- The matrix of tangents ---------------------------------------------------------------------

/// K by solving M (u, v, z) = d in double, M = [dP/du, dP/dv, D N].
dvec2 shift_by_matrix(const Plane& plane, const dvec3& P, const dvec3& N, double depth) {
    const dvec3 a = plane.dPdu, b = plane.dPdv, c = N * depth, d = normalize(P);
    const double det = dot(a, cross(b, c));
    const dvec3 local = dvec3(dot(d, cross(b, c)), dot(a, cross(d, c)), dot(a, cross(b, d))) / det;
    return dvec2(local.x, local.y) / std::abs(local.z);
}

/// The frames of the oblique split are that solution.
testing::AssertionResult solves_the_matrix(const ExactRow& row) {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const Plane plane = random_plane(random);
        Batch<float> batch(16);
        batch.material.depth = 0.3f;
        const dvec3 N = normalize(plane.normal + random_direction(random) * 0.3);
        const std::array<dvec3, 4> P = quad_points(plane);
        each_lane(batch, [&](int lane) {
            batch.set(Value::P, lane, P[lane % 4]);
            batch.set(Value::Ng, lane, plane.normal);
            batch.set(Value::vertex_normal, lane, N);
            // Exact differences, rounded once.
            set_plane_frame(batch, lane, plane);
            batch.set(Value::dPdx, lane, P[1] - P[0]);
            batch.set(Value::dPdy, lane, P[2] - P[0]);
            batch.set(Value::dUVdx, lane, plane.uv(P[1]) - plane.uv(P[0]));
            batch.set(Value::dUVdy, lane, plane.uv(P[2]) - plane.uv(P[0]));
        });
        row.frame.run(batch, row.parameters);
        if (dot(N, plane.normal) < 0.5 || batch.real(Value::r, 0) < 0.05f) continue;
        const dvec2 exact = shift_by_matrix(plane, dvec3(batch.vector3(Value::P, 0)), N, 0.3f);
        const double off = length(dvec2(batch.vector2(Value::K, 0)) - exact) / length(exact);
        if (!(off < 1e-3)) return testing::AssertionFailure() << "off by " << off;
    }
    return testing::AssertionSuccess();
}

TEST(ExactFrames, ObliqueOnesInvertTheMatrixOfTangents) {
    for (const ExactRow& row : {face(true), gram(true), cot(), inverse_tbn()})
        EXPECT_TRUE(solves_the_matrix(row)) << row.frame.id;
    EXPECT_FALSE(solves_the_matrix(gram(false)));
    EXPECT_FALSE(solves_the_matrix({{"frame-inverse-tbn@published"}, {}, true}));
}

// ---- Status, flags, facing ----------------------------------------------------------------------

/// One quad with the given window differences, in every quad of a batch of 16 lanes; a triangle of
/// the same map.
Batch<float> quad_of_triangle(const dvec3& px, const dvec3& py, const dvec2& qx, const dvec2& qy,
                              const dvec3& normal, const dvec3& face_normal) {
    Batch<float> batch(16);
    batch.material.depth = 0.5f;
    const auto J = ExactJacobian::from_edges(px, py, qx, qy);
    const bool has_area = length(cross(px, py)) > 0;
    each_lane(batch, [&](int lane) {
        batch.set(Value::P, lane, vec3<float>(0.1f, 0.2f, -2));
        batch.set(Value::vertex_normal, lane, normal);
        batch.set(Value::Ng, lane, has_area ? face_normal : dvec3(0));
        batch.set(Value::dPdx, lane, px);
        batch.set(Value::dPdy, lane, py);
        batch.set(Value::dUVdx, lane, qx);
        batch.set(Value::dUVdy, lane, qy);
        for (int c = 0; c < 3; ++c) {
            batch.real(Value::face_J, lane, c) = has_area ? static_cast<float>(J.grad_u[c]) : 0;
            batch.real(Value::face_J, lane, 3 + c) = has_area ? static_cast<float>(J.grad_v[c]) : 0;
        }
    });
    return batch;
}

testing::AssertionResult row_has_no_frame(const ExactRow& row, const dvec3& px, const dvec3& py,
                                          const dvec3& normal, const dvec3& face_normal) {
    Batch<float> batch = quad_of_triangle(px, py, u_step, v_step, normal, normalize(face_normal));
    row.frame.run(batch, row.parameters);
    const bool marked = batch.integer(Value::frame_status, 0) == static_cast<int>(Status::no_frame);
    const bool still = batch.real(Value::K, 0, 0) == 0 && batch.real(Value::K, 0, 1) == 0;
    const bool harmless = batch.real(Value::r, 0) == 1;  // displacement divides by it
    if (marked && still && harmless) return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << row.frame.id << ": status " << batch.integer(Value::frame_status, 0) << ", K.x "
           << batch.real(Value::K, 0, 0);
}

/// No area, and a vertex normal that looks away from a viewer who sees the front.
testing::AssertionResult singular_quads_have_no_frame(const ExactRow& row) {
    const dvec3 pairs[][2] = {
        {right_step, right_step * -3.0}, {dvec3(0), up_step}, {dvec3(0), dvec3(0)}};
    for (const auto& [px, py] : pairs) {
        const auto result = row_has_no_frame(row, px, py, front, front);
        if (!result) return result;
    }
    return row_has_no_frame(row, right_step, up_step, -front, front);
}

TEST(ExactFrames, SingularQuadsHaveNone) {
    for (const ExactRow& row : {face(), face(true), gram(false), gram(true), cot(), inverse_tbn()})
        EXPECT_TRUE(singular_quads_have_no_frame(row));
    EXPECT_FALSE(singular_quads_have_no_frame(flawed(Planted::frame_always_valid)));
}

/// An interpolated normal beyond the silhouette, N.V < 0 on a front face: depth along N has no
/// frame, the oblique split keeps its own.
TEST(ExactFrames, ObliqueOnesSurviveAtSilhouettes) {
    const dvec3 V = normalize(dvec3(-0.1, -0.2, 2)), nf = normalize(dvec3(1, 0, 0.15));
    const dvec3 N = normalize(dvec3(1, 0, -0.1));
    ASSERT_GT(dot(V, nf), 0);
    ASSERT_LT(dot(V, N), 0);
    const dvec3 px = cross(dvec3(0, 1, 0), nf) * 0.01, py = cross(nf, px);
    EXPECT_TRUE(row_has_no_frame(gram(false), px, py, N, nf));
    EXPECT_TRUE(row_has_no_frame(face(), px, py, N, nf));
    for (const ExactRow& row : {face(true), gram(true), cot(), inverse_tbn()})
        EXPECT_FALSE(row_has_no_frame(row, px, py, N, nf)) << row.frame.id;
}

/// J of rank 2 is not flagged; rank 1 and 0 are, are rendered, and have finite K.
testing::AssertionResult flat_uv_maps_are_flagged(const ExactRow& row) {
    const dvec2 maps[][2] = {{u_step, v_step},
                             {u_step, u_step * 0.7},
                             {dvec2(0), v_step},
                             {u_step, dvec2(0)},
                             {dvec2(0), dvec2(0)}};
    for (const auto& [qx, qy] : maps) {
        Batch<float> batch =
            quad_of_triangle(right_step, up_step, qx, qy, normalize(front), normalize(front));
        row.frame.run(batch, row.parameters);
        const bool regular = qx == u_step && qy == v_step;
        const bool flagged = (batch.integer(Value::frame_flags, 0) & HitFlag::uv_degenerate) != 0;
        const bool rendered =
            batch.integer(Value::frame_status, 0) == static_cast<int>(Status::hit);
        const bool finite = is_finite(batch.real(Value::K, 0, 0) + batch.real(Value::K, 0, 1));
        if (flagged != regular && rendered && finite) continue;
        return testing::AssertionFailure() << row.frame.id << ": qx.x " << qx.x << ", qy.x " << qy.x
                                           << ", rendered " << rendered << ", flagged " << flagged;
    }
    return testing::AssertionSuccess();
}

TEST(ExactFrames, DegenerateUvMapsAreFlagged) {
    for (const ExactRow& row : {face(), face(true), gram(false), gram(true), cot(), inverse_tbn()})
        EXPECT_TRUE(flat_uv_maps_are_flagged(row));
    EXPECT_FALSE(flat_uv_maps_are_flagged(flawed(Planted::degenerate_unnoticed)));
}

/// Seen from behind, normals flip and everything else is that of the front.
testing::AssertionResult back_faces_flip(const ExactRow& row) {
    Batch<float> from_front = quad_of_triangle(right_step, up_step, u_step, v_step, front, front);
    Batch<float> from_back = quad_of_triangle(right_step, up_step, u_step, v_step, -front, -front);
    row.frame.run(from_front, row.parameters);
    row.frame.run(from_back, row.parameters);
    constexpr auto compared = values(Value::frame_normal, Value::J, Value::r, Value::uv_rate,
                                     Value::K, Value::frame_status, Value::frame_flags);
    return same_bits<float>(from_front, from_back, compared);
}

TEST(ExactFrames, BackFacesFlipTheNormal) {
    for (const ExactRow& row : {face(), face(true), gram(false), gram(true), cot(), inverse_tbn()})
        EXPECT_TRUE(back_faces_flip(row)) << row.frame.id;
    EXPECT_FALSE(back_faces_flip({{"frame-thesis"}, {}}));
}

}  // namespace
}  // namespace quadrel::test
