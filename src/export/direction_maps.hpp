// What shaders have of tables by directions (quadrel/relief/direction_table.hpp): level 0, as an
// array of its slices, and two uniforms, the map's name with _depth and _curvature behind it.
#pragma once

#include "quadrel/quad/uniforms.hpp"

namespace quadrel {

/// Whether a slot holds such a table.
constexpr bool is_direction_map(TextureSlot slot) {
    return slot == TextureSlot::ddm || slot == TextureSlot::gdm || slot == TextureSlot::vdm;
}

}  // namespace quadrel
