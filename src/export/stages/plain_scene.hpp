// plain_maps as texts that are recorded have them.
#pragma once

#include "export/stages/plain_maps.hpp"
#include "quadrel/quad/shader_io.hpp"

namespace quadrel::recorded {

ShaderScene plain_scene(int side, int lights);

}  // namespace quadrel::recorded
