// What a stage is recorded with where no scene says more.
#pragma once

#include "quadrel/quad/shader_io.hpp"

namespace quadrel::recorded {

/// How maps are called in shaders.
std::string map_name(TextureSlot slot);

/// A camera at the origin, and lights that differ in kind: the first is directional, the second
/// fades with the square of the distance.
FrameUniforms plain_frame(int lights);

/// Square maps of `side` texels with all of their levels, repeated, trilinear; baked ones with
/// level 0 alone but for pyramids. A material that is white, in plain_frame.
ShaderScene plain_scene(int side, int lights);

}  // namespace quadrel::recorded
