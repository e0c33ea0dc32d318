// A scene's maps as a render loads them.
#pragma once

#include <memory>

#include "quadrel/scene/scene.hpp"
#include "quadrel/texture/texture_cache.hpp"

namespace quadrel::peers {

/// Out of the scene's texture cache. Throws SceneError.
std::shared_ptr<const Texture> load_map(const Scene& scene, const TextureReference& reference);

}  // namespace quadrel::peers
