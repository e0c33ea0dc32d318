// What a stage is exported with where no scene says more: a camera, lights, a material, maps.
#pragma once

#include <string>

#include "quadrel/quad/uniforms.hpp"

namespace quadrel::recorded {

/// How maps are called in shaders.
std::string map_name(TextureSlot slot);

/// Square maps of `side` texels: those of scenes and pyramids with all of their levels, other baked
/// ones with one. Tables by directions have 8 a side, 4 slices, and about as many texels a slice.
/// No texels.
TextureView plain_view(TextureSlot slot, int side);

/// A camera at the origin, and lights that differ in kind: the first is directional, the second
/// fades with the square of the distance.
FrameUniforms plain_frame(int lights);

/// White, its relief inset unless `seat` says otherwise.
MaterialUniforms plain_material(float seat = 1);

}  // namespace quadrel::recorded
