// Attribute planes as software rasterizers set them up and evaluate them, in their float32
// arithmetic: value/w and 1/w as a x + b y + c over the window. Their errors are part of what these
// implementations are; interpolation.hpp has the exact way.
//
// llvmpipe. Source: Mesa 22 to 25, lp_state_setup.c (init_args, calc_coef4,
// apply_perspective_corr), lp_bld_interp.c (interp_attrib_linear, attribs_update_simple),
// lp_setup_tri.c (order of the vertices): planes of the unsnapped vertices, anchored at the
// window's origin, evaluated by fused multiply-adds, as on every CPU that has them. (Mesa 26
// anchors them at a vertex.)
//
// SwiftShader. Source: SetupRoutine.cpp (generate, setupGradient), QuadRasterizer.cpp (rasterize,
// interpolate): planes of the snapped vertices, anchored at one of them. Its reciprocal of w is the
// correctly rounded one, as with Subzero; its LLVM backend may start from the CPU's approximation.
// (Chromium's build has 4 sub-pixel bits, the default is 8.)
//
// Both were held to what the implementations drew, bit for bit.
#pragma once

#include "quadrel/raster/interpolation.hpp"
#include "quadrel/scene/settings.hpp"

namespace quadrel {

struct ScreenTriangle;

/// Of one triangle; plain floats, so that lanes of different triangles can gather them.
struct PlaneSetup {
    float order[3];      ///< the triangle's vertices as the implementation takes them: 0, 1 or 2
    float inverse_w[3];  ///< 1 / w of the vertices in that order
    float slope[6];   ///< llvmpipe: dx01 dx20 dy01 dy20 over the area; SwiftShader: see planes.cpp
    float origin[2];  ///< window point at which the planes are anchored
    float centre;     ///< llvmpipe: where in a pixel its coordinate is taken
    float unused;
};
static_assert(sizeof(PlaneSetup) == 64, "rows of 64 bytes");

/// `samples` of a pixel. `form` is not Interpolation::exact.
PlaneSetup plane_setup(Interpolation form, const ScreenTriangle& triangle, int samples);

namespace detail {

/// Offsets of PlaneSetup's members, in floats.
inline constexpr int inverse_w_at = 3, slope_at = 6, origin_at = 12, centre_at = 14;

/// a b + c, rounded once but for a rare double rounding: the product is exact in double.
template <Number F>
F fused(F a, F b, F c) {
    return from_wide<F>(to_wide(a) * to_wide(b) + to_wide(c));
}

template <Number F>
struct AttributePlane {
    F a, b, c;
};

/// The vertex's value at a place in the implementation's order.
template <Number F>
F ordered(const PerVertex<F>& value, F vertex) {
    return select(vertex == F(0), value.v0, select(vertex == F(1), value.v1, value.v2));
}

/// `at(i)`: the lanes' float at offset i of their PlaneSetup.
template <Number F, class At>
PerVertex<F> ordered_values(const PerVertex<F>& value, const At& at) {
    return {ordered(value, at(0)), ordered(value, at(1)), ordered(value, at(2))};
}

template <Number F, class At>
AttributePlane<F> llvmpipe_plane(const PerVertex<F>& p, const At& at) {
    const F d01 = p.v0 - p.v1, d20 = p.v2 - p.v0;
    const F a = d01 * at(slope_at + 3) - d20 * at(slope_at + 2);
    const F b = d20 * at(slope_at) - d01 * at(slope_at + 1);
    return {a, b, p.v0 - (a * at(origin_at) + b * at(origin_at + 1))};
}

template <Number F, class At>
AttributePlane<F> swiftshader_plane(const PerVertex<F>& v, const At& at) {
    return {v.v0 * at(slope_at) + v.v1 * at(slope_at + 2) + v.v2 * at(slope_at + 4),
            v.v0 * at(slope_at + 1) + v.v1 * at(slope_at + 3) + v.v2 * at(slope_at + 5),
            v.v0 * at(inverse_w_at)};
}

}  // namespace detail

/// The perspective-correct value at the window point (x, y) in pixels, as llvmpipe has it.
template <Number F, class At>
F llvmpipe_value(const PerVertex<F>& value, F x, F y, const At& at) {
    using namespace detail;
    const F px = x - at(centre_at), py = y - at(centre_at);
    const auto evaluate = [&](const AttributePlane<F>& plane) {
        return fused(plane.b, py, fused(plane.a, px, plane.c));
    };
    const PerVertex<F> inverse_w{at(inverse_w_at), at(inverse_w_at + 1), at(inverse_w_at + 2)};
    const PerVertex<F> v = ordered_values(value, at);
    const F over_w = evaluate(llvmpipe_plane(
        PerVertex<F>{v.v0 * inverse_w.v0, v.v1 * inverse_w.v1, v.v2 * inverse_w.v2}, at));
    return over_w * (F(1) / evaluate(llvmpipe_plane(inverse_w, at)));
}

/// The same as SwiftShader has it. `right`, `lower`: 1 in lanes of odd x or y, else 0.
template <Number F, class At>
F swiftshader_value(const PerVertex<F>& value, F x, F y, F right, F lower, const At& at) {
    using namespace detail;
    // Its pixel centres lie at integers; the quad's own coordinates are added last.
    const F px = (x - F(0.5f) - right) + (right - at(origin_at));
    const F py = (y - F(0.5f) - lower) + (lower - at(origin_at + 1));
    const AttributePlane<F> v = swiftshader_plane(ordered_values(value, at), at);
    const F w = (at(inverse_w_at) + py * (at(slope_at + 1) + at(slope_at + 3) + at(slope_at + 5))) +
                px * (at(slope_at) + at(slope_at + 2) + at(slope_at + 4));
    return ((v.c + py * v.b) + px * v.a) * (F(1) / w);
}

}  // namespace quadrel
