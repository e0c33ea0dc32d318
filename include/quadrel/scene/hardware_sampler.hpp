// What a kind of hardware does to a sampler.
#pragma once

#include "quadrel/scene/settings.hpp"

namespace quadrel {

/// `sampler` with the precision, the formulas and the habits of `hardware`.
inline SamplerState on_hardware(SamplerState sampler, const HardwareModel& hardware) {
    sampler.lod_form = hardware.lod_form;
    sampler.weight_bits = hardware.weight_bits;
    sampler.lod_bits = hardware.lod_bits;
    sampler.scale_first = hardware.scale_first ? 1 : 0;
    sampler.quad_lod = hardware.quad_lod ? 1 : 0;
    sampler.level_rounding = hardware.level_rounding;
    return sampler;
}

}  // namespace quadrel
