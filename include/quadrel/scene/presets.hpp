// Presets: the relief of engines' own shaders, by the names under which their users know them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// What an engine ships, as a choice of stages. The arithmetic is the trace stage's.
struct Preset {
    std::string name;
    std::string summary;  ///< the engine, and what its setting is called there
    std::string map;      ///< what the engine's map holds and in which channel
    std::string source;   ///< file and version
    std::string frame, trace;
    std::map<std::string, ParameterValue> parameters{};  ///< of the trace
};

/// In the order of engines, each from its simplest search to its most elaborate.
std::span<const Preset> all_presets();

/// Null where there is none of this name.
const Preset* find_preset(std::string_view name);

/// Makes the preset's choices in a material: frame, trace, no shadow, and, where the material has a
/// normal map, that map's normals, green towards decreasing v. `key`: where the scene names the
/// preset, for messages.
void apply_preset(const Preset& preset, const std::string& key, Material& material);

}  // namespace quadrel
