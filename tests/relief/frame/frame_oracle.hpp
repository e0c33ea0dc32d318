// The exact frame of an affine UV map over a plane, in double, and how far a frame computed in
// float from rounded differences may lie from it.
//
// With px, py (qx, qy) off by at most dp (dq) in norm, J [px py] = [qx qy] gives
//     |dJ| <= 2 (|dq| + |J| |dp|) / sigma,    sigma the smaller singular value of [px py],
// the 2 because the part of J along the plane's normal is pinned to 0 by the computed plane; the
// formula's own rounding adds 24 u cond (|a| |qx| + |b| |qy|), a and b the dual basis of px and py,
// cond = |px| |py| / |px x py|. As dp is about u |P| and dq about u |uv|, that is in the order of
//     cond eps (|P| / |px| + |uv| / |qx|) |J|.
// K = D / r * J d inherits the error of J, of the unit vectors d and N, and of r = V.N.
#pragma once

#include <cmath>

#include "relief/inputs.hpp"

namespace quadrel::test {

inline constexpr double float_roundoff = 0x1p-24;

/// d(u, v) / dP in a plane: rows grad u, grad v.
struct ExactJacobian {
    dvec3 grad_u, grad_v;

    /// From two edges and the UV differences along them.
    static ExactJacobian from_edges(const dvec3& e1, const dvec3& e2, const dvec2& d1,
                                    const dvec2& d2) {
        const dvec3 n = cross(e1, e2);
        const dvec3 a = cross(e2, n) / dot(n, n), b = cross(n, e1) / dot(n, n);
        return {a * d1.x + b * d2.x, a * d1.y + b * d2.y};
    }
    dvec2 operator*(const dvec3& w) const { return {dot(grad_u, w), dot(grad_v, w)}; }
};

/// What a frame is computed from, exactly, and by how much the computed inputs may differ (norms).
struct FrameInputs {
    ExactJacobian J;
    dvec3 P, px, py, normal;  ///< `normal` of any length
    double dP = 0, dpx = 0, dpy = 0, dnormal = 0;
    dvec2 dqx = dvec2(0), dqy = dvec2(0);  ///< a component
    double depth = 1;
};

/// Exact results, and how far off the computed ones may be: J by row (norm), K by component.
struct FrameTruth {
    dvec3 grad_u, grad_v;
    dvec2 K, J_bound, K_bound;
    double r = 0, r_bound = 0;
    bool meaningful = false;  ///< errors small enough for bounds of first order
};

inline double smaller_singular_value(const dvec3& a, const dvec3& b) {
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
    const dvec3 n = cross(a, b);
    const double root = std::sqrt((aa - bb) * (aa - bb) + 4 * ab * ab);
    return std::sqrt(2 * dot(n, n) / (aa + bb + root));
}

/// Bound of |dJ| of the row `grad` (0: u, 1: v).
inline double jacobian_bound(const FrameInputs& in, const dvec3& grad, int row) {
    const double u = float_roundoff, sigma = smaller_singular_value(in.px, in.py);
    const dvec3 n = cross(in.px, in.py);
    const double cond = length(in.px) * length(in.py) / length(n);
    const double terms =
        (length(in.py) * std::abs(dot(grad, in.px)) + length(in.px) * std::abs(dot(grad, in.py))) /
        length(n);
    const double dp = std::sqrt(in.dpx * in.dpx + in.dpy * in.dpy);
    const double dq = std::sqrt(in.dqx[row] * in.dqx[row] + in.dqy[row] * in.dqy[row]);
    return 1.25 * (2 * (dq + length(grad) * dp) / sigma + 24 * u * cond * terms);
}

/// The frame of the orthogonal split: r = V.N, K = depth / r * J d.
inline FrameTruth exact_frame(const FrameInputs& in) {
    const double u = float_roundoff;
    const dvec3 V = normalize(-in.P), N = normalize(in.normal);
    FrameTruth t;
    t.grad_u = in.J.grad_u;
    t.grad_v = in.J.grad_v;
    t.J_bound = {jacobian_bound(in, t.grad_u, 0), jacobian_bound(in, t.grad_v, 1)};
    t.r = dot(V, N);
    t.K = in.J * -V * (in.depth / t.r);
    const double dV = in.dP / length(in.P) + 6 * u;
    t.r_bound = 1.25 * (dV + in.dnormal / length(in.normal) + 10 * u);
    for (int row = 0; row < 2; ++row) {
        const double length_of_row = length(row == 0 ? t.grad_u : t.grad_v);
        t.K_bound[row] = 1.25 * (in.depth / t.r * (t.J_bound[row] + length_of_row * (dV + 4 * u)) +
                                 std::abs(t.K[row]) * (t.r_bound / t.r + 4 * u));
    }
    const double dp = std::max(in.dpx, in.dpy);
    t.meaningful = dp < 0.05 * smaller_singular_value(in.px, in.py) && t.r_bound < 0.05 * t.r;
    return t;
}

/// The inputs of a quad whose lanes were rounded to float from exact points of a plane: differences
/// of the lanes of `lane`'s row and column.
inline FrameInputs rounded_inputs(const Plane& plane, const std::array<dvec3, 4>& P, int lane,
                                  const dvec3& normal, double depth) {
    const double u = float_roundoff;
    const int row = lane & 2, column = lane & 1;
    const dvec3 &left = P[row], &right = P[row + 1], &near = P[column], &far = P[column + 2];
    FrameInputs in;
    in.J = ExactJacobian::from_edges(plane.dPdu, plane.dPdv, dvec2(1, 0), dvec2(0, 1));
    in.P = P[lane];
    in.px = right - left;
    in.py = far - near;
    in.normal = normal;
    in.dP = u * length(in.P);
    in.dpx = u * (length(left) + length(right) + length(in.px));
    in.dpy = u * (length(near) + length(far) + length(in.py));
    in.dnormal = u * length(normal);
    const auto of_uv = [&](const dvec3& a, const dvec3& b) {
        return (abs(plane.uv(a)) + abs(plane.uv(b)) + abs(plane.uv(b) - plane.uv(a))) * u;
    };
    in.dqx = of_uv(left, right);
    in.dqy = of_uv(near, far);
    in.depth = depth;
    return in;
}

/// Whether lane `lane` of the batch holds the frame within its bounds.
inline testing::AssertionResult frame_within_bounds(Batch<float>& batch, int lane,
                                                    const FrameTruth& truth) {
    const auto fail = [&](const char* what, int row, double error, double bound) {
        return testing::AssertionFailure() << what << "[" << row << "] of lane " << lane
                                           << ": error " << error << ", bound " << bound;
    };
    if (batch.integer(Value::frame_status, lane) != static_cast<int>(Status::hit)) {
        return testing::AssertionFailure() << "no frame in lane " << lane;
    }
    for (int row = 0; row < 2; ++row) {
        const dvec3 grad = dvec3(batch.vector3(Value::J, lane, 3 * row));
        const double error = length(grad - (row == 0 ? truth.grad_u : truth.grad_v));
        if (!(error <= truth.J_bound[row])) return fail("J", row, error, truth.J_bound[row]);
        const double K_error = std::abs(batch.real(Value::K, lane, row) - truth.K[row]);
        if (!(K_error <= truth.K_bound[row])) return fail("K", row, K_error, truth.K_bound[row]);
    }
    const double r_error = std::abs(batch.real(Value::r, lane) - truth.r);
    if (!(r_error <= truth.r_bound)) return fail("r", 0, r_error, truth.r_bound);
    return testing::AssertionSuccess();
}

}  // namespace quadrel::test
