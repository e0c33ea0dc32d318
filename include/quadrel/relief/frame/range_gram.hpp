// J of the Gram system (gram.hpp) on ranges: as far as its inputs may move it, and no further.
//
// The text's products and quotients take the same difference many times, each time as if it could
// be another number of its range, which makes J several times as wide as it is. By the mean value
// theorem J is what it is in the middle of all ranges, and beside that at most its derivative by
// each input, anywhere in them, times how far that input may be off. With P = (px, py) and U = (qx,
// qy),
//     J = U P+,   dJ = dU P+ - J dP P+ + U (P'P)^-1 dP' n n' / n^2
// (G. Golub, V. Pereyra, SIAM Journal on Numerical Analysis 10(2), 1973).
#pragma once

#include "quadrel/relief/frame/gram.hpp"
#include "quadrel/relief/frame/range_scale.hpp"

namespace quadrel {

namespace range_detail {

/// A lane of a vector.
struct LaneVector {
    RealInterval c[3];

    LaneVector(const vec3<Ranges>& v, int lane)
        : c{v[0].lane[lane].range(), v[1].lane[lane].range(), v[2].lane[lane].range()} {}
    RealInterval operator[](int k) const { return c[k]; }
};
inline RealInterval dot(const LaneVector& a, const LaneVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// How far a number may be from its middle.
inline double radius(const RealInterval& x) { return next_up(x.width() / 2); }

template <int size>
bool is_bounded(const vec<size, Ranges>& v, int lane) {
    for (int c = 0; c < size; ++c)
        if (!v[c].lane[lane].is_bounded()) return false;
    return true;
}

/// The middle of each range, as an input.
template <int size>
vec<size, Ranges> middle_of(const vec<size, Ranges>& v) {
    vec<size, Ranges> result;
    for (int c = 0; c < size; ++c)
        for (int lane = 0; lane < 4; ++lane) {
            const double x = v[c].lane[lane].is_bounded() ? v[c].lane[lane].range().middle() : 0;
            result[c].lane[lane] = Ranged(x, x);
        }
    return result;
}

/// The inputs' duals over their ranges: rows of P+, and n.
struct GramDuals {
    vec3<Ranges> px, py, n, dual_x, dual_y;
    Ranges n2;

    GramDuals(const vec3<Ranges>& dPdx, const vec3<Ranges>& dPdy)
        : px(dPdx), py(dPdy), n(cross(px, py)) {
        n2 = n.x * n.x + n.y * n.y + n.z * n.z;
        dual_x = cross(py, n) / n2;
        dual_y = cross(n, px) / n2;
    }
    bool is_known(int lane) const {
        return is_bounded(px, lane) && is_bounded(py, lane) && is_bounded(dual_x, lane) &&
               is_bounded(dual_y, lane) && n2.lane[lane].range().lo > 0;
    }
};

/// One row of J in a lane: narrowed to `middle`, its value in the middle with that of roundings,
/// and how far the inputs move it.
inline void narrow_row(vec3<Ranges>& row, const vec3<Ranges>& middle, const GramDuals& duals,
                       const RealInterval& qx, const RealInterval& qy, int lane) {
    const LaneVector g(row, lane), a(duals.dual_x, lane), b(duals.dual_y, lane), n(duals.n, lane);
    const LaneVector px(duals.px, lane), py(duals.py, lane);
    const RealInterval n2 = duals.n2.lane[lane].range(), along_x = dot(g, a), along_y = dot(g, b);
    for (int k = 0; k < 3; ++k) {
        double off = a[k].magnitude() * radius(qx) + b[k].magnitude() * radius(qy);
        for (int m = 0; m < 3; ++m) {
            const RealInterval across = n[m] * n[k] / n2;
            off += radius(px[m]) * (along_x * across - g[m] * a[k]).magnitude() +
                   radius(py[m]) * (along_y * across - g[m] * b[k]).magnitude();
        }
        Ranged& component = row[k].lane[lane];
        const RealInterval all = component.range(), in_middle = middle[k].lane[lane].range();
        // What is rounded, is rounded alike all over ranges that are narrow.
        const RealInterval moved =
            widened(in_middle, 0.25 * in_middle.width() + off * (1 + 0x1p-40));
        component = Ranged(std::max(all.lo, moved.lo), std::min(all.hi, moved.hi));
    }
}

}  // namespace range_detail

inline SurfaceJacobian<Ranges> gram_jacobian(const vec3<Ranges>& dPdx, const vec3<Ranges>& dPdy,
                                             const vec2<Ranges>& qx, const vec2<Ranges>& qy) {
    using namespace range_detail;
    SurfaceJacobian<Ranges> j = gram_jacobian<Ranges>(dPdx, dPdy, qx, qy);
    const SurfaceJacobian<Ranges> middle =
        gram_jacobian<Ranges>(middle_of(dPdx), middle_of(dPdy), middle_of(qx), middle_of(qy));
    const GramDuals duals(dPdx, dPdy);
    for (int lane = 0; lane < 4; ++lane) {
        const bool valid = j.valid.lane[lane].known().state == RangeTruth::yes &&
                           middle.valid.lane[lane].known().state == RangeTruth::yes;
        if (!valid || !duals.is_known(lane) || !is_bounded(qx, lane) || !is_bounded(qy, lane) ||
            !is_bounded(j.grad_u, lane) || !is_bounded(j.grad_v, lane) ||
            !is_bounded(middle.grad_u, lane) || !is_bounded(middle.grad_v, lane))
            continue;
        narrow_row(j.grad_u, middle.grad_u, duals, qx.x.lane[lane].range(), qy.x.lane[lane].range(),
                   lane);
        narrow_row(j.grad_v, middle.grad_v, duals, qx.y.lane[lane].range(), qy.y.lane[lane].range(),
                   lane);
    }
    return j;
}

}  // namespace quadrel
