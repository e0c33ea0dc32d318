// Normal maps: what their texels say, and how a normal in tangent space becomes one in eye space.
//
// Green. v grows with the row of the texture. green = +1, "up": a normal with y > 0 leans towards
// growing v (n ~ (-dh/du, -dh/dv, 1)); -1, "down": towards decreasing v.
//
// Density. A tangent-space normal (x, y, z) means the slopes -x/z along u and -y/z along v, rises
// over lengths on the surface, whatever the length of a tile. Along u a tile is |dP/du| long, so
// dh/du = -(x/z) |dP/du|, and
//     n = normalize(N z + x |dP/du| grad u + y |dP/dv| grad v),
// |dP/du| = |grad v| / |grad u x grad v|. Over perpendicular axes that is T x + B y + N z with
// unit tangents; over sheared ones it is the normal that has those slopes, which T x + B y + N z
// is not.
#pragma once

#include "quadrel/relief/frame/store.hpp"
#include "quadrel/relief/map_gradients.hpp"
#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

/// What normals from a map load.
inline constexpr auto tangent_normal_inputs = values(
    Value::frame_normal, Value::J, Value::frame_status, Value::dUVdx, Value::dUVdy, Value::hit_uv);

inline constexpr ValueName green_names[] = {{-1, "down"}, {1, "up"}};

/// The parameter `green`.
template <auto member>
constexpr ParameterText green_parameter() {
    return choice<member>("green", "up: y leans towards growing v; down: decreasing", green_names,
                          1);
}

/// 2 c - 1 of a texel.
template <Number F>
vec3<F> signed_texel(const vec4<F>& c) {
    return vec3<F>(c.x, c.y, c.z) * F(2) - vec3<F>(F(1));
}

/// 2 c - 1 of the normal map at uv, with the footprint that `gradients` says.
template <class Io, class F = typename Io::Number>
vec3<F> signed_texel(const Io& io, const SampledTexture& map, const vec2<F>& uv,
                     std::int32_t gradients) {
    return signed_texel(texel_at<TextureSlot::normal>(io, map, uv, gradients));
}

/// A normal of tangent space (green +1) in eye space, and where there is one: the frame has
/// directions for it, and it has a length.
template <Number F>
struct EyeNormal {
    vec3<F> n;
    Mask<F> valid;
};

template <class Io, class F = typename Io::Number>
EyeNormal<F> tangent_to_eye(const Io& io, const vec3<F>& t) {
    const auto J = io.template load<Value::J>();
    const F scale = ordinary_scale(J[0], J[1]);  // which cancels
    const vec3<F> u = J[0] * scale, v = J[1] * scale, n = cross(u, v);
    const F area = sqrt(dot(n, n));
    const vec3<F> along_u = u * (length(v) / area), along_v = v * (length(u) / area);
    const vec3<F> N = io.template load<Value::frame_normal>();
    const vec3<F> n_eye = N * t.z + along_u * t.x + along_v * t.y;
    // Opposite gradients may cancel, and a texel may be 0; NaNs stay.
    return {normalize(n_eye), (area > F(0)) & (dot(n_eye, n_eye) != F(0))};
}

}  // namespace quadrel
