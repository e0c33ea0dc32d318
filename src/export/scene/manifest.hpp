// The index of an exported folder, for programs and for people.
#pragma once

#include <string>

#include "export/scene/content.hpp"
#include "io/document/json.hpp"

namespace quadrel {

/// Its name in the folder.
inline constexpr const char* manifest_name = "manifest.json";
/// The key that an export's manifest has, with the number of its format.
inline constexpr const char* manifest_key = "quadrel-export";
inline constexpr int manifest_format = 1;

/// manifest.json: every file of the folder and all state that drawing needs.
Json manifest_of(const ExportContent& content);

/// README.md.
std::string folder_readme(const ExportContent& content);

}  // namespace quadrel
