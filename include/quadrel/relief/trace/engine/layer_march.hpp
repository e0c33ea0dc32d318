// The march of LearnOpenGL's parallax occlusion mapping, which Godot took over: down by layers
// while the depth there is greater, then one secant.
//
// Kept of the shaders:
//   * the number of layers is real; depth and coordinate are accumulated: the last sample may lie
//     below the bottom plane by a part of a layer;
//   * texture() in the loop takes implicit derivatives: lanes that left keep their last coordinate;
//     the look-up behind the loop is of all lanes, and of another level of detail than the same
//     point's in the loop;
//   * nothing bounds the loop (here: 65536 steps, CAP); a NaN height ends it, NAN; the secant of
//     equal differences is no number, NAN.
// hit.s and hit.h are those of the last sample before the secant, after which the shaders have no
// depth.
#pragma once

#include "quadrel/relief/trace/search/counted_heights.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// From `most` layers along the surface to `least` seen from above: a real number. `z`: of the unit
/// view vector.
template <Number F>
F layers_by_angle(int least, int most, F z) {
    return mix(F(static_cast<Scalar<F>>(most)), F(static_cast<Scalar<F>>(least)), abs(z));
}

template <Number F>
struct LayerMarch {
    Mask<F> active;  ///< lanes still in the loop
    vec3<F> at;      ///< the coordinate and the ray's depth
    vec2<F> uv_step;
    F layer, depth = F(0);  ///< a layer's depth, the map's

    /// `shift`: the UV shift from the top plane to the bottom, against the ray.
    LayerMarch(const SearchRay<F>& ray, const vec2<F>& shift, F layers)
        : active(ray.active), at(ray.uv, F(0)), uv_step(shift / layers), layer(F(1) / layers) {}

    vec2<F> uv() const { return vec2<F>(at); }
    F s() const { return at.z; }

    template <class Heights>
    void descend(Heights& heights) {
        const Course course{[](const vec3<F>& to) { return vec2<F>(to); },
                            [](const vec3<F>& to, F height) { return to.z < F(1) - height; },
                            [&](const vec3<F>& from) { return from + vec3<F>(-uv_step, layer); }};
        for (const auto i :
             steps_on_course<F>(course, at, heights.heights(), active, 0, most_steps)) {
            depth = select(active, F(1) - heights(active, s(), uv()), depth);
            active = active & (s() < depth);
            if (none(active)) break;
            const Mask<F> moves = active & (number<F>(i) < number<F>(most_steps));
            at = select(moves, course.next(at), at);
        }
    }

    /// Between the last sample and the one before it; the last itself in lanes that were cut off.
    template <class Heights>
    vec2<F> secant(Heights& heights, Mask<F> searched) {
        const vec2<F> previous = select(searched, uv() + uv_step, uv());
        const F height = heights(searched, s() - layer, previous);
        const F after = depth - s();
        const F before = (F(1) - height) - s() + layer;
        return select(active, uv(), mix(uv(), previous, after / (after - before)));
    }
};

/// Searches and stores.
template <class Io, class F = typename Io::Number>
void store_layer_march(const Io& io, const SearchRay<F>& ray, const vec2<F>& shift, F layers) {
    const ImplicitHeights map(io);
    CountedHeights heights(io, map);
    LayerMarch<F> march(ray, shift, layers);
    march.descend(heights);
    const F h = heights.last();
    const vec2<F> uv = march.secant(heights, ray.active);
    const Mask<F> ended = !march.active;
    const Mask<F> no_number = is_nan(h) | !is_finite(uv.x + uv.y);
    SearchResult<F> result = heights.result(march.s(), uv, ended);
    result.h = h;
    result.status = search_status<F>(ended, ended & no_number, Status::cap);
    store_search(io, ray, result, uv);
}

}  // namespace quadrel
