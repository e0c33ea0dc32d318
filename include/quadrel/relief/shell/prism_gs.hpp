// prism-gs: relief in a prism that a geometry shader makes of each triangle: linear and binary
// search between where a ray enters the prism and where it leaves it.
//
// Corrects prism-gs@published (Rabbid76, graphics-snippets, "generalized displacement mapping"):
//   * a ray is searched once, from the triangle of the prism's surface by which it enters, not from
//     the base and from every side, ahead and back;
//   * it ends where it leaves the prism, through whichever of its triangles, not where its height
//     would be 0 or 1: the distances that the listing computes for that, and does not use. No
//     factors are left;
//   * texture space is the prism's at both ends (prism_face.hpp), whatever the triangle's size, so
//     that neighbours agree where they meet and nothing shows between them;
//   * steps are as long in all prisms: 1 / `steps` of the shell's depth, at most `most`.
// What is left of the method: between both ends the ray is taken to be straight in texture space,
// as Dachsbacher and Tatarchuk, "Prism Parallax Occlusion Mapping", 2007, have it, too. In a shell
// over a curved mesh it is not; prism-exact tells by how much. Misses what is thinner than a step.
// A ray that meets nothing is a miss, CLIP, but at the shell's bottom; one that enters below the
// surface has its hit there.
#pragma once

#include "quadrel/relief/shell/prism_face.hpp"
#include "quadrel/relief/shell/prism_march.hpp"

namespace quadrel {

/// Where a line passes a triangle of the prism's surface.
///
/// It does so where it passes all three edges on the same side. Two triangles have the same number,
/// but for its sign, for the edge that they share, so that no line slips through between them.
template <Number F>
struct TrianglePassage {
    const int (&triangle)[3];
    F weight[3];  ///< of the triangle's corners, not of sum 1
    F sum;

    /// `corner`: of the prism, from a point of the line; `turned`: PrismFace.
    TrianglePassage(const int (&of)[3], const vec3<F> (&corner)[6], const vec3<F>& d, F turned)
        : triangle(of) {
        for (int k = 0; k < 3; ++k) {
            const int from = triangle[(k + 1) % 3], to = triangle[(k + 2) % 3];
            weight[k] = dot(d, cross(corner[from], corner[to])) * turned;
        }
        sum = weight[0] + weight[1] + weight[2];
    }

    /// Whether it leaves the prism there.
    Mask<F> leaves() const {
        const F zero(0);
        return (weight[0] >= zero) & (weight[1] >= zero) & (weight[2] >= zero) & (sum > zero);
    }
    /// What has the values of(corner) at the corners, there.
    template <class Of>
    F at(const Of& of) const {
        return (of(triangle[0]) * weight[0] + of(triangle[1]) * weight[1] +
                of(triangle[2]) * weight[2]) /
               sum;
    }
};

/// A ray from where it enters a prism to where it leaves it.
///
/// As in prism_exit, a ray goes on for as long as it is within a place of the window's lattice of
/// the triangle by which it leaves.
template <class Io, class F = typename Io::Number>
PrismRay<F> straight_prism_ray(const Io& io) {
    const PrismFaces<F> face(io);
    const PrismGradients<F> gradient(face);
    const vec3<F> P = io.template load<Value::P>();
    const vec3<F> px = io.template load<Value::dPdx>(), py = io.template load<Value::dPdy>();
    const vec3<F> d = -to_viewer(P, io.frame());
    const F zero(0), never(std::numeric_limits<Scalar<F>>::infinity());
    PrismRay<F> ray = prism_ray_from(io, clamp(face.s(), zero, F(1)));
    vec3<F> corner[6];
    F ahead[6];
    for (int k = 0; k < 6; ++k) {
        corner[k] = face.corner(k) - P;
        ahead[k] = dot(corner[k], d);
    }
    const F turned = face.turned();
    F length = never, s_out = ray.s, past = zero;
    vec2<F> uv_out = ray.uv.uv;
    Mask<F> to_floor(false);
    for (const auto& triangle : prism_triangles) {
        const TrianglePassage<F> passage(triangle, corner, d, turned);
        const F t = passage.at([&](int k) { return ahead[k]; });
        const Mask<F> first = passage.leaves() & (t >= zero) & (t < length);
        const vec3<F> across = cross(corner[triangle[1]] - corner[triangle[0]],
                                     corner[triangle[2]] - corner[triangle[0]]);
        const F near = (abs(dot(across, px)) + abs(dot(across, py))) * face.snap();
        length = select(first, t, length);
        past = select(first, near / abs(dot(across, d)), past);
        const F s = passage.at([](int k) { return F(Scalar<F>(k < 3 ? 1 : 0)); });
        const F u = passage.at([&](int k) { return face.uv(k % 3).x; });
        const F v = passage.at([&](int k) { return face.uv(k % 3).y; });
        s_out = select(first, s, s_out);
        uv_out = select(first, vec2<F>(u, v), uv_out);
        to_floor = (to_floor & !first) | (first & Mask<F>(&triangle == &prism_triangles[0]));
    }
    const Mask<F> deep = ray.uv.depth > zero, ends = (length < never) & deep;
    // No further than a pixel, however flat the angle.
    past = select(ends & !to_floor & is_finite(past),
                  min(past, quadrel::length(px) + quadrel::length(py)), zero);
    ray.length = select(ends, length, zero) + past;
    ray.ends_below = to_floor | !deep;
    const F s_end = select(to_floor, F(1), clamp(s_out, zero, F(1)) + dot(gradient.s, d) * past);
    ray.s_shift = select(ends, s_end - ray.s, zero);
    const vec2<F> uv_end = uv_out + io.template load<Value::uv_rate>() * past;
    ray.uv.K = select(ends, uv_end - ray.uv.uv, vec2<F>(zero));
    return ray;
}

struct PrismGs : PrismMarchTrace {
    static constexpr StageText text{"prism-gs", "trace",
                                    "linear and binary search from side to side of a prism",
                                    "correction of prism-gs@published"};
    struct Params {
        std::int32_t steps = 50, binary_steps = 10, most = 128;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the shell's depth", 1, most_steps, 50),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         10),
        parameter<&Params::most>("most", "1", "most steps in a prism", 1, most_steps, 128)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        PrismMarch<Io> search(io, straight_prism_ray(io));
        search.march(params.steps, params.most);
        search.halve(params.binary_steps);
        search.store();
    }
};

}  // namespace quadrel
