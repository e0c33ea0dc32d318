#include "export/stages/plain_scene.hpp"

namespace quadrel::recorded {

ShaderScene plain_scene(int side, int lights) {
    ShaderScene scene(plain_frame(lights));
    scene.material = plain_material();
    for (int i = 0; i < texture_slot_count; ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        scene.textures.bind(i, map_name(slot), plain_view(slot, side), SamplerState());
    }
    return scene;
}

}  // namespace quadrel::recorded
