#include "export/stages/plain_scene.hpp"

namespace quadrel::recorded {

ShaderScene plain_scene(const PlainScene& plain) {
    ShaderScene scene(plain_frame(plain.lights));
    scene.material = plain_material(plain.seat);
    SamplerState sampler;
    sampler.wrap_u = plain.wrap_u;
    sampler.wrap_v = plain.wrap_v;
    for (int i = 0; i < texture_slot_count; ++i) {
        const auto slot = static_cast<TextureSlot>(i);
        scene.textures.bind(i, map_name(slot), plain_view(slot, plain.side), sampler);
    }
    return scene;
}

}  // namespace quadrel::recorded
