// Frame-wide conventions and the kind of hardware to be imitated.
#pragma once

#include <cstdint>

#include "quadrel/num/derivative.hpp"
#include "quadrel/texture/format.hpp"

namespace quadrel {

/// Axes, depth range, facing. gl: window y up, NDC z in [-1, 1]. vulkan: window y down, clip y
/// down, z in [0, 1]. d3d: window y down, clip y up, z in [0, 1].
enum class Conventions : std::int32_t { gl, vulkan, d3d };

/// Whose freedoms within the specifications to imitate (facts of the software rasterizers are from
/// their sources).
enum class Hardware : std::int32_t { exact, d3d, vulkan_min, llvmpipe, swiftshader, chromium };

/// How attributes get from the vertices to the fragments: within a rounding of the exact value
/// (interpolation.hpp), or in the float arithmetic of an implementation (planes.hpp).
enum class Interpolation : std::int32_t { exact, llvmpipe, swiftshader };

enum class SnapRounding : std::int32_t { half_even, half_away };

/// What a Hardware means, term by term.
struct HardwareModel {
    int subpixel_bits = 8;
    SnapRounding snap_rounding = SnapRounding::half_even;
    Interpolation interpolation = Interpolation::exact;
    DerivativeMode derivatives = DerivativeMode::fine;
    LodForm lod_form = LodForm::sqrt_max;
    int weight_bits = 0;  ///< 0: exact
    int lod_bits = 0;     ///< 0: exact
    bool scale_first = false;
    bool quad_lod = false;  ///< implicit look-ups: lane 0's level of detail for the whole quad
    LevelRounding level_rounding = LevelRounding::finer;
};

/// The model of each kind.
HardwareModel hardware_model(Hardware hardware);

enum class Cull : std::int32_t { none, back, front };

}  // namespace quadrel
