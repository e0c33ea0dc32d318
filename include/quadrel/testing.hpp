// Unit tests of derivative math: run a function over one fragment quad, look at its derivatives,
// at the mip level that a gradient selects, and at the texels that a look-up touches. No renderer,
// no scene, no test framework, no library to link (Quadrel::headers); results print themselves in
// GoogleTest. texture/sampler.hpp shows how to sample texels of one's own. An example to copy:
//
//     using namespace quadrel;
//     TEST(Shader, UvGradient) {
//         const auto q = unit::run_quad<Quad<float>>(10, 20, [](const auto& xy) {
//             return xy * Quad<float>(1.0f / 64);     // any text over the number type
//         });
//         EXPECT_EQ(q.dFdx_fine(0), vec2<float>(1.0f / 64, 0));
//         const auto mip = unit::select_level({256, 256}, q.dFdx_fine(0), q.dFdy_fine(0));
//         EXPECT_EQ(mip.level, 2.0);                  // 4 texels a pixel
//     }
//
// On dual numbers (num/dual.hpp) the same text also has its exact derivatives at each lane's own
// position, and so what the finite differences are off by:
//
//     TEST(Shader, CurvedGradient) {
//         const auto q = unit::run_quad<Quad<Dual>>(10, 20, [](const auto& xy) {
//             return xy.x * xy.x;
//         });
//         EXPECT_EQ(q.exact_dx(0), 21);               // 2 x at x = 10.5
//         EXPECT_EQ(q.dFdx_fine(0), 22);              // 11.5^2 - 10.5^2
//         EXPECT_EQ(q.dFdx_coarse(3) - q.exact_dx(3), -1);
//     }
#pragma once

#include <array>
#include <ostream>

#include "quadrel/num/derivative.hpp"
#include "quadrel/num/dual.hpp"
#include "quadrel/texture/footprint.hpp"
#include "quadrel/texture/texture.hpp"

namespace quadrel::unit {

/// One lane of a packet: float or double (the value of a dual number), or a vector of them.
template <Packet F>
Scalar<F> lane_of(const F& packet, int lane) {
    Scalar<F> all[lanes_of<F>];
    store(all, packet);
    return all[lane];
}
template <glm::length_t n, Packet F>
glm::vec<n, Scalar<F>, glm::defaultp> lane_of(const glm::vec<n, F, glm::defaultp>& packet,
                                              int lane) {
    glm::vec<n, Scalar<F>, glm::defaultp> v;
    for (glm::length_t i = 0; i < n; ++i) v[i] = lane_of(packet[i], lane);
    return v;
}

/// What a function gave over a quad: V is a packet or a vector of packets. Lanes: 0 (left, smaller
/// y), 1 (right, smaller y), 2 (left, larger y), 3 (right, larger y).
template <class V>
struct QuadResult {
    V value;

    auto operator[](int lane) const { return lane_of(value, lane); }
    auto dFdx_fine(int lane) const { return lane_of(dFdx(value, DerivativeMode::fine), lane); }
    auto dFdy_fine(int lane) const { return lane_of(dFdy(value, DerivativeMode::fine), lane); }
    auto dFdx_coarse(int lane) const { return lane_of(dFdx(value, DerivativeMode::coarse), lane); }
    auto dFdy_coarse(int lane) const { return lane_of(dFdy(value, DerivativeMode::coarse), lane); }
    /// On Quad<Dual>: the derivatives of the text itself at the lane's position.
    auto exact_dx(int lane) const { return lane_of(quadrel::exact_dx(value), lane); }
    auto exact_dy(int lane) const { return lane_of(quadrel::exact_dy(value), lane); }
};

/// Four positions as a packet of F; wider packets repeat the quad. Dual numbers are differentiated
/// by them.
template <Packet F>
vec2<F> positions(const std::array<vec2<double>, 4>& at) {
    Scalar<F> x[lanes_of<F>], y[lanes_of<F>];
    for (int i = 0; i < lanes_of<F>; ++i) {
        x[i] = static_cast<Scalar<F>>(at[i % 4].x);
        y[i] = static_cast<Scalar<F>>(at[i % 4].y);
    }
    const vec2<F> all(load<F>(x), load<F>(y));
    if constexpr (Differentiated<F>)
        return {with_derivatives(all.x, 1, 0), with_derivatives(all.y, 0, 1)};
    else
        return all;
}

/// Runs `shader(position)` at four given positions, in lane order.
template <Packet F, class Shader>
auto run_quad(const std::array<vec2<double>, 4>& at, const Shader& shader) {
    auto value = shader(positions<F>(at));
    return QuadResult<decltype(value)>{value};
}

/// Runs it at the pixel centres of the quad that holds window pixel (x, y).
template <Packet F, class Shader>
auto run_quad(int x, int y, const Shader& shader) {
    const double left = (x & ~1) + 0.5, low = (y & ~1) + 0.5;
    return run_quad<F>(
        std::array<vec2<double>, 4>{vec2<double>(left, low), vec2<double>(left + 1, low),
                                    vec2<double>(left, low + 1), vec2<double>(left + 1, low + 1)},
        shader);
}

/// An RGBA texture of constant colour with a full mip chain, for questions about levels alone.
/// Sizes in [1, 4096].
inline SampledTexture level_texture(vec2<int> size, const SamplerState& sampler = {}) {
    static const float texel[4] = {};
    SampledTexture texture{};
    texture.view.texels = texel;
    texture.view.channels = 4;
    texture.view.faces = 1;
    texture.view.levels = full_mip_levels(size.x, size.y);
    for (int l = 0; l < texture.view.levels; ++l) {
        texture.view.width[l] = std::max(1, size.x >> l);
        texture.view.height[l] = std::max(1, size.y >> l);
    }
    texture.sampler = sampler;
    return texture;
}

/// The level that gradients of uv (per pixel) select on a texture of `size` texels.
template <class T>
LaneLod select_level(vec2<int> size, const vec2<T>& dx, const vec2<T>& dy,
                     const SamplerState& sampler = {}) {
    using F = Quad<T>;
    const auto lod = compute_lod(level_texture(size, sampler), vec2<F>(F(dx.x), F(dx.y)),
                                 vec2<F>(F(dy.x), F(dy.y)));
    return detail::lane_lod(lod, 0);
}

/// The texels and weights that a look-up at uv with these gradients touches.
template <class T>
LaneFootprint touched_texels(const SampledTexture& texture, const vec2<T>& uv, const vec2<T>& dx,
                             const vec2<T>& dy) {
    using F = Quad<T>;
    const auto broadcast = [](const vec2<T>& v) { return vec2<F>(F(v.x), F(v.y)); };
    const auto lod = compute_lod(texture, broadcast(dx), broadcast(dy));
    return lane_footprint(texture, broadcast(uv), lod, 0);
}

}  // namespace quadrel::unit

namespace quadrel {

inline std::ostream& operator<<(std::ostream& out, const LaneLod& lod) {
    return out << "rho " << lod.rho << " lambda " << lod.lambda << " level " << lod.level
               << " frac " << lod.frac << (lod.magnified ? " magnified" : "");
}
inline std::ostream& operator<<(std::ostream& out, const TexelTap& tap) {
    return out << "level " << tap.level << " (" << tap.x << ", " << tap.y << ")"
               << (tap.border ? " border" : "") << " weight " << tap.weight;
}
inline std::ostream& operator<<(std::ostream& out, const LaneFootprint& footprint) {
    out << footprint.lod;
    for (const TexelTap& tap : footprint.taps) out << "; " << tap;
    return out;
}

}  // namespace quadrel
