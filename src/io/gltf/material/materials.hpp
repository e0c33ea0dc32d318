// The materials of a glTF file in the words of scene files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/document/json.hpp"
#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {

/// What one of the keys says, in words.
struct GltfWord {
    std::string text, key;
};

struct GltfMaterial {
    int number = -1;  ///< in the file's list; -1 for triangles without one, which take nothing
    std::string name;
    Json keys = Json::object();     ///< of a scene's material, each a default; files by full names
    std::vector<GltfWord> words;    ///< of all keys that there are words for
    std::vector<std::string> left;  ///< what there are no keys for, and why
};

/// Those of the triangles that a mesh of these options has, by their numbers. Throws InputError.
std::vector<GltfMaterial> read_gltf_materials(const std::filesystem::path& file,
                                              const MeshFileOptions& options);

}  // namespace quadrel
