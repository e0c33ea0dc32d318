// The normal that traces with slope information read beside the height.
//
// A bound normal map is decoded as 2 c - 1 along the frame's T, B and N; swizzle the texture where
// its channels mean other directions. Without one the normal is that of the height field itself,
// by central differences over one texel to either side.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// What a stage loads that calls map_normal and eye_in_relief.
inline constexpr auto map_normal_inputs =
    search_inputs_and(Value::P, Value::T, Value::B, Value::frame_normal, Value::J, Value::r);

/// Unit normal of the relief, in eye space.
template <Number F>
struct MapNormal {
    vec3<F> n;
    int fetches;  ///< that it took per lane
};

/// n times the axis of the relief and times the unit view vector.
template <Number F>
struct Slope {
    F nz, nv;
};

template <class Io, class F = typename Io::Number>
Slope<F> slope(const Io& io, const vec3<F>& n) {
    return {dot(n, io.template load<Value::frame_normal>()),
            dot(n, to_viewer(io.template load<Value::P>(), io.frame()))};
}

/// h(uv + d) - h(uv - d) over 2 d, d one texel: the slope a unit of u (or v).
template <Number F, class Heights>
F central_slope(const Heights& heights, Mask<F> active, const vec2<F>& uv, const vec2<F>& d,
                F texels) {
    return (heights(active, uv + d) - heights(active, uv - d)) * (texels * F(0.5f));
}

/// normalize(N - D (h_u grad u + h_v grad v)).
template <class Io, class Heights, class F = typename Io::Number>
vec3<F> height_normal(const Io& io, const Heights& heights, Mask<F> active, const vec2<F>& uv) {
    const TexelSize<F> size(height_map(io));
    const vec2<F> du(size.step.x, F(0)), dv(F(0), size.step.y);
    const F h_u = central_slope(heights, active, uv, du, size.texels.x);
    const F h_v = central_slope(heights, active, uv, dv, size.texels.y);
    const auto J = io.template load<Value::J>();
    const vec3<F> tilt = (J[0] * h_u + J[1] * h_v) * io.template load<Value::relief_depth>();
    return normalize(io.template load<Value::frame_normal>() - tilt);
}

/// `heights` are the height map's, for the case that no normal map is bound.
template <class Io, class Heights, class F = typename Io::Number>
MapNormal<F> map_normal(const Io& io, const Heights& heights, Mask<F> active, const vec2<F>& uv) {
    const SampledTexture* const map = io.template texture<TextureSlot::normal>();
    if (map == nullptr) return {height_normal(io, heights, active, uv), 4};
    const auto context = io.template context<TextureSlot::normal>(active);
    const vec4<F> c = sample_expanded(*map, context, uv, undisplaced_lod(io, *map));
    const vec3<F> n = vec3<F>(c) * F(2) - vec3<F>(F(1));
    return {normalize(io.template load<Value::T>() * n.x + io.template load<Value::B>() * n.y +
                      io.template load<Value::frame_normal>() * n.z),
            1};
}

/// Adds the look-ups of a normal in the lanes of `active`.
template <Number F>
void count_normal(Int<F>& counter, Mask<F> active, const MapNormal<F>& normal) {
    counter = counter + select(active, Int<F>(normal.fetches), Int<F>(0));
}

}  // namespace quadrel
