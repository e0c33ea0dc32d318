// Reading a scene file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Reads a scene: JSON with comments, as data/scenes/README.md describes it. A name
/// without extension ("thesis-quad", "rows/linear") is looked up as scenes/<name>.json in the data
/// directories. A file that
/// ends in ".glib" is read as a scene of glman, as that of "Derivative-Based Relief Mapping"
/// (2012); its name alone is looked for in the data directories too. `overrides`
/// are assignments "key=value" ("material.relief.steps=256") made before anything is read. Meshes
/// are loaded, textures only looked for.
/// Throws InputError for anything wrong with the input, with file, line, key, what was found and
/// what was expected; UsageError for an override that is not an assignment.
Scene load_scene(const std::filesystem::path& file_or_name,
                 const std::vector<std::string>& overrides = {});

/// The names of the installed scenes, sorted.
std::vector<std::string> installed_scenes();

/// What a scene shows, by its file: the comment that it begins with, in one line; empty if there is
/// none. Throws InputError for a file that cannot be read.
std::string scene_description(const std::filesystem::path& file_or_name);

}  // namespace quadrel
