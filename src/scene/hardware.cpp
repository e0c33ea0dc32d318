// What each kind of hardware means. Sources: Direct3D 11.3 functional specification (sections
// 3.4.1, 7.18.8, 7.18.10, 7.18.16), Vulkan specification (required limits, texel coordinate
// systems), Mesa (llvmpipe: lp_rast.h, lp_setup_tri.c, lp_bld_sample.c, lp_bld_quad.c; lavapipe's
// reported limits) and SwiftShader (VkConfig.hpp, SetupRoutine.cpp, SamplerCore.cpp,
// SpirvShaderArithmetic.cpp).
#include "quadrel/check.hpp"
#include "quadrel/scene/settings.hpp"

namespace quadrel {
namespace {

// 16.8 fixed point, rounded to nearest even, used for coverage and for attribute set-up; texel
// weights and level of detail with 8 fraction bits; the level of detail from the major axis of the
// footprint's ellipse. Derivatives are the vendor's choice: fine.
HardwareModel d3d() { return {.lod_form = LodForm::ellipse, .weight_bits = 8, .lod_bits = 8}; }

// The least that Vulkan 1.0 allows: subPixelPrecisionBits, subTexelPrecisionBits and
// mipmapPrecisionBits of 4. Coordinates are scaled before they are wrapped, as the specification
// writes it. Rounding and derivative mode are left open there: half to even, fine.
HardwareModel vulkan_min() {
    return {.subpixel_bits = 4, .weight_bits = 4, .lod_bits = 4, .scale_first = true};
}

// FIXED_ORDER 8 with cvtps (half to even); attribute planes of the unsnapped vertices; every
// derivative is the fine one; float weights; exact rho^2 with a piecewise linear log2. Look-ups
// with implicit derivatives take rho^2 from lane 0's differences alone (lp_build_rho: element 0 of
// lp_build_packed_ddx_ddy_twocoord, packed or swizzled to its quad). Each lane's own are: dFdx, a
// level, a bias or gradients that the shader gives, and cube maps (observed in Mesa 22.3.6). The
// nearest level is the CPU's rounding: half to even.
HardwareModel llvmpipe() {
    return {.interpolation = Interpolation::llvmpipe,
            .lod_form = LodForm::linear_log2,
            .quad_lod = true,
            .level_rounding = LevelRounding::even};
}

// 8 bits from RoundInt, attribute planes from the same fixed positions; unqualified derivatives
// are coarse; rho^4's bits read as an integer for log2, of lane 0's differences for the whole quad;
// the nearest level half to even; float texel weights on the high-precision path.
HardwareModel swiftshader() {
    return {.interpolation = Interpolation::swiftshader,
            .derivatives = DerivativeMode::coarse,
            .lod_form = LodForm::quartic_log2,
            .quad_lod = true,
            .level_rounding = LevelRounding::even};
}

// SwiftShader as Chromium builds it: with SWIFTSHADER_LEGACY_PRECISION, which is 4 sub-pixel bits.
HardwareModel chromium() {
    HardwareModel model = swiftshader();
    model.subpixel_bits = 4;
    return model;
}

}  // namespace

HardwareModel hardware_model(Hardware hardware) {
    switch (hardware) {
        case Hardware::exact:
            return {};
        case Hardware::d3d:
            return d3d();
        case Hardware::vulkan_min:
            return vulkan_min();
        case Hardware::llvmpipe:
            return llvmpipe();
        case Hardware::swiftshader:
            return swiftshader();
        case Hardware::chromium:
            return chromium();
    }
    QUADREL_CHECK(false, static_cast<int>(hardware));
}

}  // namespace quadrel
