// How scenes, bakes and, with underscores, shaders call the maps of a material.
#pragma once

#include <array>
#include <string_view>

#include "quadrel/quad/uniforms.hpp"

namespace quadrel {

/// In the order of TextureSlot; a baked map has the name of its kind of bake.
inline constexpr std::array<std::string_view, texture_slot_count> texture_slot_names{
    "height",
    "color",
    "gloss",
    "emissive",
    "normal",
    "environment",
    "layers",
    "layers_2",
    "layers_3",
    "layer_normals_x",
    "layer_normals_y",
    "color_2",
    "color_3",
    "color_4",
    "max-mip",
    "min-max",
    "texel-max",
    "cone",
    "cone-robust",
    "cone-quick",
    "cone-rabbid",
    "cone-cell",
    "relaxed-cone",
    "relaxed-cone-exact",
    "quad-cone",
    "aniso-cone",
    "distance",
    "distance-exact",
    "horizon",
    "horizon-sampled",
    "rmq",
    "layer-bounds",
    "ddm",
    "gdm",
    "vdm",
    "prewarp"};

}  // namespace quadrel
