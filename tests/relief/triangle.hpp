// A triangle in eye space as the interpolation sees it: float vertices, perspective by w = -z.
#pragma once

#include "quadrel/raster/interpolation.hpp"
#include "relief/frame/frame_oracle.hpp"
#include "relief/vertex_inputs.hpp"
#include "ulp.hpp"

namespace quadrel::test {

struct Triangle {
    std::array<vec3<float>, 3> P, normal;
    std::array<vec2<float>, 3> uv;
    std::array<dvec2, 3> window;  ///< pixels

    ExactJacobian jacobian() const {
        return ExactJacobian::from_edges(dvec3(P[1]) - dvec3(P[0]), dvec3(P[2]) - dvec3(P[0]),
                                         dvec2(uv[1]) - dvec2(uv[0]), dvec2(uv[2]) - dvec2(uv[0]));
    }
    dvec3 face_normal() const {
        return normalize(cross(dvec3(P[1]) - dvec3(P[0]), dvec3(P[2]) - dvec3(P[0])));
    }
    PrimitiveData data() const {
        PrimitiveData d{};
        for (int i = 0; i < 3; ++i) {
            d.w[i] = -P[i].z;
            for (int c = 0; c < 3; ++c) {
                d.position[i][c] = P[i][c];
                d.normal[i][c] = normal[i][c];
                d.face_normal[c] = static_cast<float>(face_normal()[c]);
            }
            for (int c = 0; c < 2; ++c) d.uv[i][c] = uv[i][c];
        }
        return d;
    }
    /// The triangle's own J; its edges as tangents, object axes as in eye space.
    PrimitiveFrame frame() const {
        PrimitiveFrame f{};
        const auto J = jacobian();
        for (int c = 0; c < 3; ++c) {
            f.J[c] = static_cast<float>(J.grad_u[c]);
            f.J[3 + c] = static_cast<float>(J.grad_v[c]);
            f.object_axes[c][c] = 1;
            for (int i = 0; i < 3; ++i) {
                f.tangent[i][c] = P[1][c] - P[0][c];
                f.bitangent[i][c] = P[2][c] - P[0][c];
                f.tangent_sign[i] = 1;
                f.quadric[i][0] = 0.5f - 0.2f * static_cast<float>(i);
                f.quadric[i][1] = -0.1f + 0.2f * static_cast<float>(i);
            }
        }
        return f;
    }
    /// Vertices whose tangents and binormals are the plane's, unit.
    PrimitiveVertices vertices() const {
        const auto J = jacobian();
        const dvec3 n = cross(J.grad_u, J.grad_v);
        const dvec3 T = normalize(cross(J.grad_v, n)), B = normalize(cross(n, J.grad_u));
        std::array<VertexAxes, 3> axes;
        for (std::size_t v = 0; v < 3; ++v) axes[v] = {T, B, normalize(dvec3(normal[v]))};
        PrimitiveVertices row = vertex_row({dvec3(P[0]), dvec3(P[1]), dvec3(P[2])}, axes);
        for (std::size_t v = 0; v < 3; ++v)
            for (int c = 0; c < 2; ++c) row.uv[v][c] = uv[v][c];
        return row;
    }
    /// Twice the signed area of (window[i + 1], window[i + 2], at): the edge function opposite of
    /// vertex i.
    double edge(int i, const dvec2& at) const {
        const dvec2 a = window[(i + 1) % 3], b = window[(i + 2) % 3];
        return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
    }
};

/// On a random plane, 4 to 40 pixels a side in a view of 400 pixels; vertex normals lean from the
/// face's.
inline Triangle random_triangle(Random& random, double lean) {
    for (;;) {
        const Plane plane = random_plane(random);
        Triangle t;
        for (int i = 0; i < 3; ++i) {
            t.window[i] = {random.uniform(-20, 20), random.uniform(-20, 20)};
            const dvec3 P = on_plane(plane, t.window[i], 1.0 / 400);
            if (P.z > -0.2) t.window[0] = t.window[1];
            t.P[i] = vec3<float>(P);
            t.uv[i] = vec2<float>(plane.uv(P));
            t.normal[i] = vec3<float>(plane.normal + random_direction(random) * lean);
        }
        const double area = t.edge(0, t.window[0]);
        if (std::abs(area) > 40 && dot(t.face_normal(), plane.normal) > 0.999) return t;
    }
}

/// An attribute's exact value at a lane, and the bound of interpolation.hpp for its error.
template <int size>
struct Interpolated {
    vec<size, double> value{0.0}, error{0.0};
};

template <int size>
Interpolated<size> interpolate_exactly(const Batch<float>& batch, int lane, const Triangle& t,
                                       const std::array<vec<size, float>, 3>& at_vertex) {
    double q[3], s = 0, absolute = 0;
    for (int i = 0; i < 3; ++i) {
        q[i] = static_cast<double>(batch.edges[i][lane]) / -static_cast<double>(t.P[i].z);
        s += q[i];
        absolute += std::abs(q[i]);
    }
    Interpolated<size> result;
    vec<size, double> largest(0.0);
    for (int i = 0; i < 3; ++i) {
        const vec<size, double> at(at_vertex[i]);
        result.value += at * (q[i] / s);
        largest = max(largest, abs(at));
    }
    for (int c = 0; c < size; ++c)
        result.error[c] =
            (interpolation_ulps * float_ulp(result.value[c]) + interpolation_unit * largest[c]) *
            (absolute / std::abs(s));
    return result;
}

/// The exact inputs of a lane's frame, with the errors that interpolation and differences bring.
inline FrameInputs interpolated_inputs(const Batch<float>& batch, int lane, const Triangle& t) {
    const double u = float_roundoff;
    const auto at = [&](int other, const auto& attribute) {
        return interpolate_exactly(batch, (lane & ~3) + other, t, attribute);
    };
    const int row = lane & 2, column = lane & 1;
    const auto left = at(row, t.P), right = at(row + 1, t.P);
    const auto near = at(column, t.P), far = at(column + 2, t.P), own = at(lane & 3, t.P);
    const auto normal = at(lane & 3, t.normal);
    FrameInputs in;
    in.J = t.jacobian();
    in.P = own.value;
    in.px = right.value - left.value;
    in.py = far.value - near.value;
    in.normal = normal.value;
    in.dP = length(own.error);
    in.dpx = length(left.error) + length(right.error) + u * length(in.px);
    in.dpy = length(near.error) + length(far.error) + u * length(in.py);
    in.dnormal = length(normal.error);
    const auto uv_error = [&](int a, int b) {
        const auto first = at(a, t.uv), second = at(b, t.uv);
        return first.error + second.error + abs(second.value - first.value) * u;
    };
    in.dqx = uv_error(row, row + 1);
    in.dqy = uv_error(column, column + 2);
    in.depth = batch.material.depth;
    return in;
}

/// Puts quads of `t` into the batch, each around a random point of the triangle: up to three of a
/// quad's lanes may be helpers.
template <PlainFloat T>
void fill_quads_of(Batch<T>& batch, const Triangle& t, Random& random) {
    batch.primitives = {t.data()};
    batch.frames = {t.frame()};
    batch.vertices = {t.vertices()};
    for (int quad = 0; quad < batch.lanes / 4; ++quad) {
        double a = random.uniform(0, 1), b = random.uniform(0, 1);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const dvec2 p = t.window[0] * (1 - a - b) + t.window[1] * a + t.window[2] * b;
        const dvec2 corner(2 * std::floor(p.x / 2) + 0.5, 2 * std::floor(p.y / 2) + 0.5);
        for (int k = 0; k < 4; ++k) {
            const dvec2 centre = corner + dvec2(k % 2, k / 2);
            batch.primitive[4 * quad + k] = 0;
            for (int i = 0; i < 3; ++i) {
                batch.edges[i][4 * quad + k] = t.edge(i, centre);
            }
        }
    }
}

}  // namespace quadrel::test
