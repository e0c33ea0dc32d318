// The stages of a material that names none.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quadrel {

/// Where a material has its heights from.
enum class HeightSource : std::uint8_t { none, map, noise, layers };

/// The id of the stage that a material runs in a room that scenes choose from, where its scene
/// names none.
std::string default_stage(std::string_view room, HeightSource heights);

}  // namespace quadrel
