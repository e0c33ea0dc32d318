#include "scene_maps.hpp"

namespace quadrel::peers {

std::shared_ptr<const Texture> load_map(const Scene& scene, const TextureReference& reference) {
    TextureOptions options;
    options.swizzle = reference.swizzle;
    options.srgb = reference.srgb;
    options.format = reference.format;
    options.mip_rule = reference.mip_rule;
    options.flip_v = reference.flip_v;
    return scene.texture_cache->load(reference.file, options);
}

}  // namespace quadrel::peers
