// Every stage by its id: what it is, what it reads and writes, which parameters it takes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quadrel/quad/stage.hpp"

namespace quadrel {

/// A stage as the planner and `list algorithms` see it.
struct StageInfo {
    StageText text;
    std::span<const Value> inputs, outputs;
    std::span<const TextureSlot> textures;
    std::span<const ParameterText> parameters;
    std::span<const std::string_view> number_types;
    std::size_t params_size;
    /// Whether it reads the height map itself (its texels, sizes or levels), so that heights of
    /// noise do not serve it.
    bool needs_height_map;
    /// Writes the parameters' defaults into `params` (params_size bytes, aligned for any type).
    void (*set_defaults)(void* params);
};

/// All stages, in the order of the data flow.
std::span<const StageInfo> all_stages();

/// The stage of that id, or null.
const StageInfo* find_stage(std::string_view id);

/// Name of a texture slot in scene files: height, color, gloss, emissive, normal, environment.
std::string_view slot_name(TextureSlot slot);

}  // namespace quadrel
