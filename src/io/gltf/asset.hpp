// Versions and extensions of a glTF file, and what geometry leaves alone.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace quadrel {

/// Throws InputError, with `name` as the file, unless a reader of glTF 2.0 can read the asset
/// (glTF 2.0, 3.2).
void check_gltf_version(const std::string& name, const nlohmann::json& root);

/// Throws InputError for a required extension that may change geometry and is not known here.
void check_gltf_extensions(const std::string& name, const nlohmann::json& root);

/// Names of extensions that are not applied, and of other parts that nothing here reads.
std::vector<std::string> ignored_in_gltf(const nlohmann::json& root);

}  // namespace quadrel
