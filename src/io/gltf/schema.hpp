// What a glTF file's JSON may hold, as far as geometry reads it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace quadrel {

/// The part of `root` that geometry reads, with whole numbers as integers, however they are written
/// (glTF 2.0, 2.7); extensions and extras are left out. Throws InputError, with `name` as the file,
/// for a missing property, one of another type, and numbers out of range: every MUST that one value
/// can violate alone.
nlohmann::json checked_gltf(const std::string& name, const nlohmann::json& root);

}  // namespace quadrel
