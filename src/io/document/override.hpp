// The structure of a scene file as a whole: known keys, and values replaced from the command line.
#pragma once

#include <string>

#include "io/document/json.hpp"

namespace quadrel {

/// Throws InputError if the document is not an object that begins with "quadrel": 1, or has a key
/// that the format does not know anywhere (the message names the nearest known key).
void check_scene_keys(const SceneDocument& document);

/// Sets one value: `path.to[0].key=value`, the value read as JSON, else as a string. Objects that
/// the format knows are made where absent; names (of textures, materials, meshes) must exist.
/// `material.x` reaches the first of "materials" where the file has no "material". The value null
/// removes the key, if it is there.
/// Throws InputError for an unknown path and UsageError for a text that is not key=value.
void apply_override(SceneDocument& document, const std::string& assignment);

}  // namespace quadrel
