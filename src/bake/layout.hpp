// Where the texels of a baked map lie: levels one after the other, each of all layers, at multiples
// of 64 bytes.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

/// Width and height of a level.
using LevelSize = std::pair<int, int>;

/// Nothing if there are more levels or texels than a texture may hold.
std::optional<TextureView> make_layout(int channels, int layers,
                                       const std::vector<LevelSize>& levels);

}  // namespace quadrel
