// What a stage is recorded with where no scene says more.
#pragma once

#include "quadrel/quad/shader_io.hpp"

namespace quadrel::recorded {

/// How maps are called in shaders.
std::string map_name(TextureSlot slot);

/// Square maps of `side` texels with all of their levels, repeated, trilinear; baked ones with
/// level 0 alone but for pyramids. A material that is white, and `lights` lights, the first one
/// directional.
ShaderScene plain_scene(int side, int lights);

}  // namespace quadrel::recorded
