// The judge of searches of shells: where a ray through a tetrahedron first is at or below the
// surface. One text for long double and for rationals; it shares nothing with the kernels' texts:
// cells come from the middles of intervals, and of every quadratic both roots are looked at.
#pragma once

#include "relief/layer/layer_oracle.hpp"
#include "relief/shell/prism_rays.hpp"

namespace quadrel::test::oracle {

/// A ray in texture space over t in [0, 1], and how exactly that can be known.
struct PrismPath {
    Ray uv;              ///< s_polygon 0
    Real z, rise;        ///< height where it enters, and how much higher it leaves
    Real length;         ///< world units
    bool to_floor;       ///< it leaves through the shell's bottom
    bool floor_is_near;  ///< it would but for rounding, or might not
    Real end_error;      ///< of the exit, in t
    Real height_error;
};

inline Real dot3(const float (&a)[3], const Real (&b)[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Real length3(const float (&a)[3]) {
    return std::sqrt(Real(a[0]) * a[0] + Real(a[1]) * a[1] + Real(a[2]) * a[2]);
}

/// By the row of the lane's face and its place in it.
template <PlainFloat T>
PrismPath prism_path(Batch<T>& batch, int lane, const Field& field) {
    const auto l = static_cast<std::size_t>(lane);
    const ShellFace face = face_of(batch.vertices[static_cast<std::size_t>(batch.primitive[l])]);
    const Real u = std::numeric_limits<T>::epsilon();
    Real P[3], d[3], squared = 0;
    for (int i = 0; i < 3; ++i) {
        P[i] = batch.real(Value::P, lane, i);
        squared += P[i] * P[i];
    }
    for (int i = 0; i < 3; ++i) d[i] = P[i] / std::sqrt(squared);
    const Real sum = Real(batch.edges[0][l]) + batch.edges[1][l] + batch.edges[2][l];
    PrismPath path{};
    Real s = 0, exits[3];
    path.length = std::numeric_limits<Real>::infinity();
    int last = -1;
    for (int k = 0; k < 3; ++k) {
        const Real weight = Real(batch.edges[static_cast<std::size_t>(k)][l]) / sum;
        s += weight * face.s[k];
        const Real rate = dot3(face.gradient[k], d);
        exits[k] =
            rate < 0 ? std::max<Real>(weight, 0) / -rate : std::numeric_limits<Real>::infinity();
        if (exits[k] >= path.length) continue;
        path.length = exits[k];
        last = k;
        const Real off = 16 * u * (1 + length3(face.gradient[k]) * path.length);
        path.end_error = std::min<Real>(1, off / (std::fabs(rate) * path.length + off));
    }
    if (last < 0) path.length = 0;
    path.to_floor = last >= 0 && face.to_floor == Real(last);
    const int floor = static_cast<int>(face.to_floor);
    const Real reach = path.length * (1 + 2 * path.end_error) + 64 * u;
    int within = 0;
    for (const Real exit : exits) within += exit <= reach;
    path.floor_is_near = floor >= 0 && exits[floor] <= reach && within > 1;
    s = std::clamp<Real>(s, 0, 1);
    path.z = 1 - s;
    path.rise = path.to_floor ? s - 1 : -dot3(face.s_gradient, d) * path.length;
    const float grad_u[3] = {face.J[0], face.J[1], face.J[2]};
    const float grad_v[3] = {face.J[3], face.J[4], face.J[5]};
    path.uv = {batch.real(Value::uv, lane, 0), batch.real(Value::uv, lane, 1),
               dot3(grad_u, d) * path.length, dot3(grad_v, d) * path.length, 0};
    const Real texels = field.width * (std::fabs(path.uv.u) + length3(grad_u) * path.length) +
                        field.height * (std::fabs(path.uv.v) + length3(grad_v) * path.length);
    path.height_error = 16 * u * (2 + texels + length3(face.s_gradient) * path.length);
    return path;
}

/// Above the ray by how much, over a part of it: A t^2 + B t + C with t from its beginning.
template <class N>
LayerQuadratic<N> above_patch(const Field& field, const LayerRay<N>& ray, const N& z, const N& rise,
                              const N& t, long i, long j) {
    N h[4];
    for (int corner = 0; corner < 4; ++corner)
        h[corner] = number_of<N>(field.texel(i + corner % 2, j + corner / 2));
    const N b = h[1] - h[0], c = h[2] - h[0], e = h[0] - h[1] - h[2] + h[3];
    const N f = ray.x + ray.dx * t - number_of<N>(i), g = ray.y + ray.dy * t - number_of<N>(j);
    return {e * ray.dx * ray.dy, b * ray.dx + c * ray.dy + e * (f * ray.dy + g * ray.dx) - rise,
            h[0] + b * f + c * g + e * f * g - z - rise * t};
}

/// The same of one of a cell's triangles: the one that the ray is over at `middle`.
template <class N>
LayerQuadratic<N> above_triangle(const Field& field, const LayerRay<N>& ray, const N& z,
                                 const N& rise, const N& t, const N& middle, long i, long j,
                                 bool main_diagonal) {
    const auto texel = [&](long x, long y) { return number_of<N>(field.texel(i + x, j + y)); };
    const auto place = [&](const N& at) {
        return std::pair<N, N>(ray.x + ray.dx * at - number_of<N>(i),
                               ray.y + ray.dy * at - number_of<N>(j));
    };
    const auto [fm, gm] = place(middle);
    const auto [f, g] = place(t);
    N slope_x, slope_y, corner;
    if (main_diagonal) {
        const bool lower = gm < fm;
        slope_x = lower ? N(texel(1, 0) - texel(0, 0)) : N(texel(1, 1) - texel(0, 1));
        slope_y = lower ? N(texel(1, 1) - texel(1, 0)) : N(texel(0, 1) - texel(0, 0));
        corner = texel(0, 0);
    } else {
        const bool lower = fm + gm < 1;
        slope_x = lower ? N(texel(1, 0) - texel(0, 0)) : N(texel(1, 1) - texel(0, 1));
        slope_y = lower ? N(texel(0, 1) - texel(0, 0)) : N(texel(1, 1) - texel(1, 0));
        corner = lower ? texel(0, 0) : N(texel(1, 1) - slope_x - slope_y);
    }
    return {N(0), slope_x * ray.dx + slope_y * ray.dy - rise,
            corner + slope_x * f + slope_y * g - z - rise * t};
}

/// First t in [0, end] at which the surface, raised by `lift`, is at or above the ray; infinite if
/// there is none.
template <class N>
Real meet_prism(const Field& field, const PrismPath& path, PrismSurface surface, Real lift = 0,
                Real until = 1) {
    const LayerRay<N> ray(field, path.uv);
    const N z = number_of<N>(path.z - lift), rise = number_of<N>(path.rise);
    const N end = number_of<N>(until);
    const auto real = [](const N& x) {
        if constexpr (std::same_as<N, mpq_class>)
            return static_cast<Real>(x.get_d());
        else
            return x;
    };
    // Where it crosses the diagonals of cells: x - y or x + y is whole.
    const bool main = surface == PrismSurface::tri_main;
    const N across = main ? N(ray.x - ray.y) : N(ray.x + ray.y);
    const N across_rate = main ? N(ray.dx - ray.dy) : N(ray.dx + ray.dy);
    const N infinite = end + 1;
    for (N t = 0; t < end || (t == 0 && end == 0);) {
        N to = infinite;
        const auto border = [&](const N& start, const N& rate) {
            if (rate == 0) return;
            const N at = LayerRay<N>::next_border(start, rate, t);
            if (at < to) to = at;
        };
        border(ray.x, ray.dx);
        border(ray.y, ray.dy);
        if (surface != PrismSurface::bilinear) border(across, across_rate);
        if (to > end) to = end;
        const N middle = (t + to) / 2, length = to - t;
        const long i = floor_of(N(ray.x + ray.dx * middle));
        const long j = floor_of(N(ray.y + ray.dy * middle));
        const LayerQuadratic<N> q =
            surface == PrismSurface::bilinear
                ? above_patch<N>(field, ray, z, rise, t, i, j)
                : above_triangle<N>(field, ray, z, rise, t, middle, i, j, main);
        if (q.C >= 0) return real(t);
        std::vector<N> roots = roots_of(q, length);
        if (q.A == 0 && q.B != 0) {
            const N root = -q.C / q.B;
            roots = root > 0 && !(root > length) ? std::vector<N>{root} : std::vector<N>{};
        }
        if (!roots.empty()) return real(t + *std::min_element(roots.begin(), roots.end()));
        if (!(to > t)) break;
        t = to;
    }
    return std::numeric_limits<Real>::infinity();
}

}  // namespace quadrel::test::oracle
