// GLSL as C++: what the exported functions are compiled with, to be held to the stages that they
// were made of. Numbers are floats, and functions those of num/. Look-ups are the library's.
#pragma once

#include <array>
#include <bit>
#include <vector>

#include "quadrel/num/functions.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/quad/uniforms.hpp"
#include "quadrel/quad/value.hpp"
#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel::glsl {

using vec2 = quadrel::vec2<float>;
using vec3 = quadrel::vec3<float>;
using vec4 = quadrel::vec4<float>;
using Packet = Quad<float>;

inline constexpr int STATUS_NONE = 0, STATUS_HIT = 1, STATUS_FLOOR = 2, STATUS_CAP = 3,
                     STATUS_CLIP = 4, STATUS_NO_FRAME = 5, STATUS_NAN = 6, STATUS_OUTSIDE = 7;
inline constexpr int FLAG_DEGENERATE_UV = HitFlag::uv_degenerate,
                     FLAG_AMBIGUOUS = HitFlag::ambiguous, FLAG_START_BELOW = HitFlag::start_below,
                     FLAG_WRAPPED = HitFlag::wrapped, FLAG_NAN_LOOK_UP = HitFlag::nan_look_up;

inline vec2 xy(const vec3& v) { return {v.x, v.y}; }
inline vec2 xy(const vec4& v) { return {v.x, v.y}; }
inline vec3 xyz(const vec4& v) { return {v.x, v.y, v.z}; }

// ---- Functions ----------------------------------------------------------------------------------

using quadrel::abs;
using quadrel::acos;
using quadrel::asin;
using quadrel::atan;
using quadrel::ceil;
using quadrel::clamp;
using quadrel::copysign;
using quadrel::cos;
using quadrel::cross;
using quadrel::distance;
using quadrel::dot;
using quadrel::exp;
using quadrel::exp2;
using quadrel::exponent;
using quadrel::floor;
using quadrel::fract;
using quadrel::inversesqrt;
using quadrel::length;
using quadrel::log;
using quadrel::log2;
using quadrel::max;
using quadrel::min;
using quadrel::mix;
using quadrel::mod;
using quadrel::normalize;
using quadrel::pow;
using quadrel::power_of_two;
using quadrel::reflect;
using quadrel::refract;
using quadrel::sign;
using quadrel::significand;
using quadrel::sin;
using quadrel::sqrt;
using quadrel::step;
using quadrel::tan;
using quadrel::to_int;
using quadrel::trunc;

inline float atan(float y, float x) { return atan2(y, x); }
inline float roundEven(float x) { return round_even(x); }
inline bool isnan(float x) { return x != x; }
inline int min(int a, int b) { return b < a ? b : a; }
inline int max(int a, int b) { return a < b ? b : a; }
inline int floatBitsToInt(float x) { return as_int(x); }
inline float intBitsToFloat(int x) { return std::bit_cast<float>(x); }

template <int n>
vec<n, float> inversesqrt(const vec<n, float>& v) {
    return map_components([](float x) { return inversesqrt(x); }, v);
}
template <int n>
vec<n, float> pow(const vec<n, float>& a, const vec<n, float>& b) {
    return map_components([](float x, float y) { return pow(x, y); }, a, b);
}
template <int n>
vec<n, float> exp2(const vec<n, float>& v) {
    return map_components([](float x) { return exp2(x); }, v);
}
template <int n>
vec<n, float> exp(const vec<n, float>& v) {
    return map_components([](float x) { return exp(x); }, v);
}
template <int n>
vec<n, float> log2(const vec<n, float>& v) {
    return map_components([](float x) { return log2(x); }, v);
}
template <int n>
vec<n, float> trunc(const vec<n, float>& v) {
    return map_components([](float x) { return trunc(x); }, v);
}
template <int n>
vec<n, float> roundEven(const vec<n, float>& v) {
    return map_components([](float x) { return round_even(x); }, v);
}

// ---- Neighbours ---------------------------------------------------------------------------------

/// The fragments of a quad are run one after the other, and again: what one has of its neighbours
/// is what they had in the run before. Each use of a neighbour's value has a number, in the order
/// in which a fragment comes to them.
struct QuadRun {
    int lane = 0;
    std::size_t use = 0;
    std::array<std::vector<float>, 4> now, before;

    void begin(int of_lane) {
        lane = of_lane;
        use = 0;
        now[static_cast<std::size_t>(lane)].clear();
    }
    void end_of_round() { before = now; }
    void forget() { now = before = {}; }

    /// The value of all fragments; of those that do not come to this use, the fragment's own.
    Packet all(float x) {
        now[static_cast<std::size_t>(lane)].push_back(x);
        Packet result(x);
        for (std::size_t i = 0; i < 4; ++i)
            if (i != static_cast<std::size_t>(lane) && use < before[i].size())
                result.lane[i] = before[i][use];
        ++use;
        return result;
    }
    float own(const Packet& x) const { return x.lane[lane]; }
};
inline QuadRun quad_run;

inline float dFdx(float x) { return quad_run.own(quadrel::dFdx(quad_run.all(x))); }
inline float dFdy(float x) { return quad_run.own(quadrel::dFdy(quad_run.all(x))); }
inline float dFdxFine(float x) { return dFdx(x); }
inline float dFdyFine(float x) { return dFdy(x); }
template <int n>
vec<n, float> dFdx(const vec<n, float>& v) {
    return map_components([](float x) { return dFdx(x); }, v);
}
template <int n>
vec<n, float> dFdy(const vec<n, float>& v) {
    return map_components([](float x) { return dFdy(x); }, v);
}
template <int n>
vec<n, float> dFdxFine(const vec<n, float>& v) {
    return dFdx(v);
}
template <int n>
vec<n, float> dFdyFine(const vec<n, float>& v) {
    return dFdy(v);
}

// ---- Textures -----------------------------------------------------------------------------------

struct sampler {
    const SampledTexture* map = nullptr;
};

inline vec4 first_lane(const quadrel::vec4<Packet>& v) {
    return {v.x.lane[0], v.y.lane[0], v.z.lane[0], v.w.lane[0]};
}
inline quadrel::vec2<Packet> packet(const vec2& v) { return {Packet(v.x), Packet(v.y)}; }

inline vec4 textureLod(sampler of, vec2 uv, float level) {
    return first_lane(texture_lod(*of.map, {}, packet(uv), Packet(level)));
}
inline vec4 textureGrad(sampler of, vec2 uv, vec2 dx, vec2 dy) {
    return first_lane(texture_grad(*of.map, {}, packet(uv), packet(dx), packet(dy)));
}
inline vec4 textureGather(sampler of, vec2 uv, int component) {
    return first_lane(texture_gather(*of.map, {}, packet(uv), component));
}
inline vec4 texture(sampler of, vec2 uv) {
    const Packet u = quad_run.all(uv.x), v = quad_run.all(uv.y);
    const auto texel =
        quadrel::texture(*of.map, SampleContext<Packet>(), quadrel::vec2<Packet>(u, v));
    return {quad_run.own(texel.x), quad_run.own(texel.y), quad_run.own(texel.z),
            quad_run.own(texel.w)};
}
inline vec4 texture(sampler of, vec3 direction) {
    const Packet x = quad_run.all(direction.x), y = quad_run.all(direction.y),
                 z = quad_run.all(direction.z);
    const auto texel =
        texture_cube(*of.map, SampleContext<Packet>(), quadrel::vec3<Packet>(x, y, z));
    return {quad_run.own(texel.x), quad_run.own(texel.y), quad_run.own(texel.z),
            quad_run.own(texel.w)};
}
/// A layer of an array; layers follow each other in memory.
inline vec4 textureLod(sampler of, vec3 uv_and_layer, float) {
    SampledTexture layer = *of.map;
    layer.view.offset[0] += static_cast<int>(uv_and_layer.z) * layer.view.channels *
                            layer.view.width[0] * layer.view.height[0];
    return textureLod({&layer}, {uv_and_layer.x, uv_and_layer.y}, 0.0f);
}
/// Rows may go on below the map's last one, where tables of several maps follow each other.
inline vec4 texel_fetch(sampler of, int x, int y, int level) {
    const TextureView& view = of.map->view;
    const float* const texel =
        view.texels + view.offset[level] + (y * view.width[level] + x) * view.channels;
    vec4 result(0.0f, 0.0f, 0.0f, 1.0f);
    for (int c = 0; c < view.channels; ++c) result[c] = texel[c];
    return result;
}
inline vec4 texel_of_layer(sampler of, int x, int y, int layer, int level) {
    return texel_fetch(of, x, layer * of.map->view.height[level] + y, level);
}
inline int texture_size(sampler of, int level, int axis) {
    return axis == 0 ? of.map->view.width[level] : of.map->view.height[level];
}

// ---- Uniforms -----------------------------------------------------------------------------------

inline sampler height_map_nearest, height_map, color_map, gloss_map, emissive_map, normal_map,
    environment_map, layers_map, layers_2_map, layers_3_map, layer_normals_x_map,
    layer_normals_y_map, color_2_map, color_3_map, color_4_map, max_mip_map, min_max_map,
    texel_max_map, cone_map, cone_robust_map, cone_quick_map, cone_rabbid_map, cone_cell_map,
    relaxed_cone_map, relaxed_cone_exact_map, quad_cone_map, aniso_cone_map, distance_map,
    distance_exact_map, horizon_map, horizon_sampled_map, rmq_map, layer_bounds_map, ddm_map,
    gdm_map, vdm_map, prewarp_map;
/// In the order of TextureSlot.
inline sampler* const samplers[] = {&height_map,
                                    &color_map,
                                    &gloss_map,
                                    &emissive_map,
                                    &normal_map,
                                    &environment_map,
                                    &layers_map,
                                    &layers_2_map,
                                    &layers_3_map,
                                    &layer_normals_x_map,
                                    &layer_normals_y_map,
                                    &color_2_map,
                                    &color_3_map,
                                    &color_4_map,
                                    &max_mip_map,
                                    &min_max_map,
                                    &texel_max_map,
                                    &cone_map,
                                    &cone_robust_map,
                                    &cone_quick_map,
                                    &cone_rabbid_map,
                                    &cone_cell_map,
                                    &relaxed_cone_map,
                                    &relaxed_cone_exact_map,
                                    &quad_cone_map,
                                    &aniso_cone_map,
                                    &distance_map,
                                    &distance_exact_map,
                                    &horizon_map,
                                    &horizon_sampled_map,
                                    &rmq_map,
                                    &layer_bounds_map,
                                    &ddm_map,
                                    &gdm_map,
                                    &vdm_map,
                                    &prewarp_map};
static_assert(std::size(samplers) == static_cast<std::size_t>(texture_slot_count));

/// Of RandomShells.
inline sampler shell_table;

inline vec3 eye, light0_position, light0_ambient, light0_diffuse, light0_specular, light1_position,
    light1_ambient, light1_diffuse, light1_specular;
inline float eye_to_world[9], projection[16], model_view[16], inverse_model_view[16], depth_scale,
    depth_offset, light0_intensity, light0_constant, light0_linear, light0_quadratic,
    light1_intensity, light1_constant, light1_linear, light1_quadratic, ddm_map_depth,
    gdm_map_depth, vdm_map_depth, vdm_map_curvature;

}  // namespace quadrel::glsl
