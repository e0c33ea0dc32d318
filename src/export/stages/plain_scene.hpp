// plain_maps as texts that are recorded have them.
#pragma once

#include "export/stages/plain_maps.hpp"
#include "quadrel/quad/shader_io.hpp"

namespace quadrel::recorded {

/// What may be said of it.
struct PlainScene {
    int side = 1024;  ///< of the maps, in texels
    int lights = 2;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;  ///< of the maps
    float seat = 1;                                     ///< height at which the polygon lies
};

ShaderScene plain_scene(const PlainScene& plain);

}  // namespace quadrel::recorded
