// A scene as a folder that another program draws: shaders, buffers, textures, numbers, and what
// Quadrel makes of it.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "quadrel/render.hpp"

namespace quadrel {

struct SceneExport {
    std::string language = "glsl";
    std::vector<std::string> channels;  ///< that the shaders write; none: all that they can
    /// false: without expected.exr and the textures' decoded levels, for who has them.
    bool reference = true;
    /// As RenderOptions has them.
    int threads = 0;
    double baking_limit = 20;
    std::function<void(double)> progress;
    std::function<void(const std::string& map, double share)> baking;
    std::function<void(const std::string& reason)> not_kept;
};

/// The names of the files of the export in a folder; none if there is no export.
std::set<std::string> exported_files(const std::filesystem::path& folder);

/// Throws UsageError unless an export may be written there: a free name, an empty folder, or one
/// that holds an export and nothing else.
void check_export_folder(const std::filesystem::path& folder);

/// Writes the folder whole or not at all. Equal scenes and options give equal bytes. Throws
/// UsageError for what cannot be a shader, with stage and reason, InputError as `render` does, and
/// OutputError.
void export_scene(const Scene& scene, const SceneExport& options,
                  const std::filesystem::path& folder);

}  // namespace quadrel
