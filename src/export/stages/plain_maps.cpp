#include "export/stages/plain_maps.hpp"

#include <algorithm>

#include "export/direction_maps.hpp"
#include "quadrel/quad/slot_names.hpp"
#include "quadrel/quad/value.hpp"

namespace quadrel::recorded {

std::string map_name(TextureSlot slot) {
    std::string name(texture_slot_names[static_cast<std::size_t>(slot)]);
    std::replace(name.begin(), name.end(), '-', '_');
    return name + "_map";
}

namespace {

int channels_of(TextureSlot slot) {
    switch (slot) {
        case TextureSlot::height:
        case TextureSlot::max_mip:
        case TextureSlot::texel_max:
        case TextureSlot::distance:
        case TextureSlot::distance_exact:
        case TextureSlot::horizon:
        case TextureSlot::horizon_sampled:
        case TextureSlot::rmq:
        case TextureSlot::ddm:
        case TextureSlot::gdm:
        case TextureSlot::vdm:
            return 1;
        case TextureSlot::color:
        case TextureSlot::gloss:
        case TextureSlot::emissive:
        case TextureSlot::normal:
        case TextureSlot::environment:
        case TextureSlot::layers:
        case TextureSlot::layer_normals_x:
        case TextureSlot::layer_normals_y:
        case TextureSlot::color_2:
        case TextureSlot::color_3:
        case TextureSlot::color_4:
        case TextureSlot::layers_2:
        case TextureSlot::layers_3:
        case TextureSlot::layer_bounds:
        case TextureSlot::quad_cone:
        case TextureSlot::aniso_cone:
        case TextureSlot::prewarp:
            return 4;
        default:
            return 2;
    }
}

constexpr int plain_directions = 8, plain_slices = 4;

/// As direction_table.hpp has it: an eighth as many columns as the heights have texels.
TextureView plain_table(int side) {
    const int columns = std::max(side / plain_directions, 1);
    TextureView view{};
    view.channels = 1;
    view.faces = plain_slices;
    view.levels = 3;
    view.width[0] = view.height[0] = columns * plain_directions;
    view.width[1] = view.height[1] = columns;
    view.width[2] = 2;
    view.height[2] = 1;
    for (int level = 1; level < view.levels; ++level)
        view.offset[level] =
            view.offset[level - 1] + view.faces * view.width[level - 1] * view.height[level - 1];
    return view;
}

}  // namespace

FrameUniforms plain_frame(int lights) {
    FrameUniforms frame{};
    frame.light_count = std::min(lights, max_lights);
    for (int i = 0; i < frame.light_count; ++i) {
        LightUniforms& light = frame.lights[i];
        light.directional = i == 0 ? 1 : 0;
        light.intensity = 1;
        light.attenuation[0] = 1;
        light.attenuation[1] = i == 0 ? 0.0f : 0.25f;
        light.attenuation[2] = i == 0 ? 0.0f : 0.5f;
    }
    return frame;
}

TextureView plain_view(TextureSlot slot, int side) {
    if (is_direction_map(slot)) return plain_table(side);
    TextureView view{};
    view.channels = channels_of(slot);
    view.faces = slot == TextureSlot::environment ? 6 : 1;
    const bool is_pyramid = slot == TextureSlot::max_mip || slot == TextureSlot::min_max ||
                            slot == TextureSlot::texel_max || slot == TextureSlot::layer_bounds;
    view.levels = slot < first_baked_slot || is_pyramid ? full_mip_levels(side, side) : 1;
    int offset = 0;
    for (int level = 0; level < view.levels; ++level) {
        view.width[level] = view.height[level] = std::max(side >> level, 1);
        view.offset[level] = offset;
        offset += view.channels * view.faces * view.width[level] * view.height[level];
    }
    return view;
}

MaterialUniforms plain_material(float seat) {
    MaterialUniforms material{};
    material.seat = seat;
    material.depth = 0.1f;
    material.shininess = 60;
    for (float* color : {material.ambient, material.diffuse, material.specular})
        std::fill_n(color, 3, 1.0f);
    return material;
}

}  // namespace quadrel::recorded
