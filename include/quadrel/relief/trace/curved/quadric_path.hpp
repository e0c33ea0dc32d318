// The path of a ray over a surface that falls away by a quadric: second order, in closed form.
#pragma once

#include "quadrel/relief/trace/curved/curved_path.hpp"

namespace quadrel {

/// s = s_polygon + sigma - c sigma^2, from where that comes in at the top to where it leaves, there
/// or at the bottom.
template <Number F>
struct QuadricPath {
    SearchRay<F> ray;
    F c;
    F first, last;     ///< sigma where it comes in, and where it leaves
    Mask<F> descends;  ///< it leaves at the bottom

    QuadricPath(const SearchRay<F>& search, F bend) : ray(search), c(bend) {
        const F above(ray.s_polygon), below = F(1) - above;
        const F in = F(1) + F(4) * c * above, down = F(1) - F(4) * c * below;
        // Where a hollow has no top above the fragment: from the path's highest point.
        first = select(in >= F(0), F(-2) * above / (F(1) + sqrt(max(in, F(0)))), F(0.5f) / c);
        descends = down >= F(0);
        const F out = F(0.5f) * (F(1) + sqrt(max(in, F(0)))) / c;
        last = select(descends, F(2) * below / (F(1) + sqrt(max(down, F(0)))), out);
    }

    PathPoint<F> operator()(F sigma) const {
        return {ray.uv + ray.K * sigma, F(ray.s_polygon) + sigma - c * sigma * sigma, sigma};
    }
};

}  // namespace quadrel
