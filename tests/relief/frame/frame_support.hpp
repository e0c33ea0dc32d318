// What the tests of frames share: a frame under test on planes and triangles, exact frames of both
// splits, and changes of the plane under which K stays or follows.
#pragma once

#include "relief/planted.hpp"
#include "relief/triangle.hpp"

namespace quadrel::test {

using Frame = StageUnderTest<float>;

/// A step in the window to the right and one upwards, in eye space and in UV, and the normal of
/// their plane.
inline const dvec3 right_step(0.01, 0, 0), up_step(0, 0.01, 0.002), front(0, -0.2, 1);
inline const dvec2 u_step(0.02, 0), v_step(0.005, 0.03);

/// Fills what frames read beside window differences: the plane's own J and tangents.
inline void set_plane_frame(Batch<float>& batch, int lane, const Plane& plane) {
    const auto J = ExactJacobian::from_edges(plane.dPdu, plane.dPdv, dvec2(1, 0), dvec2(0, 1));
    for (int c = 0; c < 3; ++c) {
        batch.real(Value::face_J, lane, c) = static_cast<float>(J.grad_u[c]);
        batch.real(Value::face_J, lane, 3 + c) = static_cast<float>(J.grad_v[c]);
    }
    batch.set(Value::vertex_tangent, lane, plane.dPdu);
    batch.set(Value::vertex_bitangent, lane, plane.dPdv);
    batch.real(Value::tangent_sign, lane) = 1;
}

/// What the vertices of frame-mikkt carry: unit tangent, handedness, unit normal.
inline void set_plane_mikkt(Batch<float>& batch, int lane, const Plane& plane) {
    batch.set(Value::vertex_tangent, lane, normalize(plane.dPdu));
    batch.set(Value::vertex_bitangent, lane, plane.normal);
    batch.real(Value::tangent_sign, lane) =
        dot(cross(plane.normal, plane.dPdu), plane.dPdv) < 0 ? -1.0f : 1.0f;
}

/// The frame of the oblique split: J N = 0, r = (V.Nf) / (N.Nf). Errors of the inputs reach J, in
/// first order, as those of the orthogonal one do, over the cosine c = N.Nf, and with N's own.
/// `normal_from_steps`: r has the errors of a face normal made of the window differences.
inline FrameTruth exact_oblique_frame(const FrameInputs& in, const dvec3& face_normal,
                                      bool normal_from_steps = false) {
    const double u = float_roundoff;
    const dvec3 V = normalize(-in.P), N = normalize(in.normal);
    const double c = std::abs(dot(N, face_normal));
    const double dN = in.dnormal / length(in.normal) + 6 * u, dV = in.dP / length(in.P) + 6 * u;
    const double sigma = smaller_singular_value(in.px, in.py);
    const double dF = normal_from_steps ? 2 * (in.dpx + in.dpy) / sigma + 24 * u : 4 * u;
    FrameTruth t;
    const auto oblique = [&](const dvec3& grad) {
        return grad - face_normal * (dot(grad, N) / dot(N, face_normal));
    };
    t.grad_u = oblique(in.J.grad_u);
    t.grad_v = oblique(in.J.grad_v);
    FrameInputs steps = in;
    steps.J = {t.grad_u, t.grad_v};
    for (int row = 0; row < 2; ++row) {
        const dvec3& grad = row == 0 ? t.grad_u : t.grad_v;
        t.J_bound[row] =
            1.25 * (jacobian_bound(steps, grad, row) / c + length(grad) * (dN + dF + 8 * u) / c);
    }
    t.r = dot(V, face_normal) / dot(N, face_normal);
    t.r_bound = 1.25 * ((dV + dF + 4 * u) / c + std::abs(t.r) * (dN + dF + 6 * u) / c);
    t.K = dvec2(dot(t.grad_u, -V), dot(t.grad_v, -V)) * (in.depth / t.r);
    for (int row = 0; row < 2; ++row) {
        const double grad = length(row == 0 ? t.grad_u : t.grad_v);
        t.K_bound[row] = 1.25 * (in.depth / t.r * (t.J_bound[row] + grad * (dV + 4 * u)) +
                                 std::abs(t.K[row]) * (t.r_bound / t.r + 4 * u));
    }
    const double dp = std::max(in.dpx, in.dpy);
    t.meaningful = dp < 0.05 * sigma && t.r_bound < 0.05 * t.r && c > 0.2;
    return t;
}

/// The inputs of a frame that takes J from the triangle's vertices: only rounding to float is left
/// of the window differences' errors.
inline FrameInputs vertex_inputs(FrameInputs in) {
    in.px = normalize(in.px);
    in.py = normalize(in.py - in.px * dot(in.px, in.py));
    in.dpx = in.dpy = 2 * float_roundoff;
    in.dqx = in.dqy = dvec2(0);
    return in;
}

/// Triangles with P, uv, normals, differences and vertex data in every lane; calls
/// `lane(batch, lane, inputs, triangle)` for each after the frame ran.
inline void each_lane_of_triangles(
    const Frame& frame, const Parameters& parameters, int triangles, double lean,
    const std::function<void(Batch<float>&, int, const FrameInputs&, const Triangle&)>& visit) {
    for (int i = 0; i < triangles; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const Triangle t = random_triangle(random, lean);
        Batch<float> batch(64);
        batch.material.depth = static_cast<float>(random.uniform(0.01, 1));
        fill_quads_of(batch, t, random);
        batch.run("interpolate");
        batch.run("differentiate");
        frame.run(batch, parameters);
        for (int lane = 0; lane < batch.lanes; ++lane)
            visit(batch, lane, interpolated_inputs(batch, lane, t), t);
    }
}

// ---- Changes of a plane -------------------------------------------------------------------------

/// A change of the plane in eye space or of its UV map, and what K becomes by it.
struct PlaneChange {
    const char* name;
    Plane (*plane)(Plane);
    dvec2 (*K)(const dvec2&);
};

inline dvec3 rolled_by_37_degrees(const dvec3& v) {
    constexpr double c = 0.8, s = 0.6;  // rational sine and cosine
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

inline const PlaneChange camera_roll{
    "camera roll",
    [](Plane p) {
        return Plane{rolled_by_37_degrees(p.origin), rolled_by_37_degrees(p.normal),
                     rolled_by_37_degrees(p.dPdu), rolled_by_37_degrees(p.dPdv), p.uv0};
    },
    [](const dvec2& K) { return K; }};
inline const PlaneChange mirrored_u{"mirrored U",
                                    [](Plane p) {
                                        p.dPdu = -p.dPdu;
                                        return p;
                                    },
                                    [](const dvec2& K) { return dvec2(-K.x, K.y); }};
/// w = u' dPdu + v' (dPdv / 2 + dPdu * sqrt(3) / 2).
inline const PlaneChange sheared{
    "60 degrees of shear",
    [](Plane p) {
        p.dPdv = p.dPdv * 0.5 + p.dPdu * std::sqrt(0.75);
        return p;
    },
    [](const dvec2& K) { return dvec2(K.x - K.y * std::sqrt(3.0), K.y * 2); }};
inline const PlaneChange anisotropic{"anisotropy 1:8",
                                     [](Plane p) {
                                         p.dPdv = p.dPdv * 8.0;
                                         return p;
                                     },
                                     [](const dvec2& K) { return dvec2(K.x, K.y / 8); }};

/// A plane whose tiles are squares.
inline Plane random_square_plane(Random& random) {
    Plane plane = random_plane(random);
    const double across = dot(cross(plane.normal, plane.dPdu), plane.dPdv) < 0 ? -1 : 1;
    plane.dPdv = cross(plane.normal, plane.dPdu) * across;
    plane.uv0 = dvec2(0.25, 0.75);
    return plane;
}

/// The four points of a quad whose lane 0 is at the plane's origin.
inline std::array<dvec3, 4> quad_points(const Plane& plane) {
    std::array<dvec3, 4> P;
    for (int i = 0; i < 4; ++i) P[i] = on_plane(plane, dvec2(i % 2, i / 2), 1.0 / 400);
    return P;
}

/// Lane 0's K for a plane under the eye, and its bound.
struct PlaneShift {
    dvec2 K, bound;
    bool meaningful;
};

inline PlaneShift shift_over(const Frame& frame, const Plane& plane) {
    Batch<float> batch(16);
    batch.material.depth = 1;
    const std::array<dvec3, 4> P = quad_points(plane);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::P, lane, vec3<float>(P[lane % 4]));
        batch.set(Value::uv, lane, vec2<float>(plane.uv(P[lane % 4])));
        batch.set(Value::Ng, lane, vec3<float>(plane.normal));
        batch.set(Value::vertex_normal, lane, vec3<float>(plane.normal));
        set_plane_frame(batch, lane, plane);
        if (frame.id == "frame-mikkt") set_plane_mikkt(batch, lane, plane);
    }
    batch.run("differentiate");
    frame.run(batch);
    const FrameTruth truth = exact_frame(rounded_inputs(plane, P, 0, plane.normal, 1));
    return {dvec2(batch.vector2(Value::K, 0)), truth.K_bound * 2.0, truth.meaningful};
}

/// Part of the planes at which the changed K is what it should be.
inline double unchanged_part(const Frame& frame, const PlaneChange& change, Plane (*make)(Random&),
                             int planes) {
    Random random(7);
    int agree = 0, compared = 0;
    while (compared < planes) {
        Plane plane = make(random);
        plane.uv0 = dvec2(0.25, 0.75);
        const PlaneShift before = shift_over(frame, plane);
        const PlaneShift after = shift_over(frame, change.plane(plane));
        if (!before.meaningful || !after.meaningful) continue;
        ++compared;
        // The bound of the first K, brought into the coordinates of the second.
        const dvec2 of_x = abs(change.K(dvec2(before.bound.x, 0)));
        const dvec2 of_y = abs(change.K(dvec2(0, before.bound.y)));
        const dvec2 off = abs(change.K(before.K) - after.K), bound = of_x + of_y + after.bound;
        agree += off.x <= bound.x && off.y <= bound.y;
    }
    return static_cast<double>(agree) / planes;
}

}  // namespace quadrel::test
