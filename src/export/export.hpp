// Stages as shaders: the module quadrel-shaders, loaded when something is first exported.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "export/table.hpp"

namespace quadrel {

/// The module's table. Throws UsageError where it is not installed.
const ExportTable& export_table();

struct ExportOptions {
    std::string language = "glsl";
    const void* params = nullptr;  ///< the stage's Params; null: the defaults
    int side = 1024;               ///< of the maps, in texels
    int lights = 2;
    bool uniforms = false;  ///< parameters are uniforms where they can be, not constants
};

struct ExportRow {
    std::string id, room, refusal;  ///< refusal: why it cannot be written; empty where it can
};
/// All of Quadrel's own stages.
std::vector<ExportRow> export_rows();
std::vector<std::string> export_languages();

/// The stage's function and all that it needs. Throws UsageError with the reason where there is
/// none.
std::string export_stage(std::string_view id, const ExportOptions& options);

}  // namespace quadrel
