// The material of a glTF file in the words of scene files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel {

struct GltfMaterial {
    std::string name;
    Json keys;                       ///< of a scene's material, each a default; files by full names
    std::vector<std::string> taken;  ///< what they say, in words
    std::vector<std::string> left;   ///< what there are no keys for, and why
};

/// Of the file's drawn triangles, where all have the same one; without keys, and with the reason
/// in `left`, where they have several. Empty in everything where they have none. `uv_set` as the
/// mesh is read with. Throws InputError.
GltfMaterial read_gltf_material(const std::filesystem::path& file, int uv_set);

}  // namespace quadrel
