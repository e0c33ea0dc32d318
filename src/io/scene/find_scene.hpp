// Scenes by their names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace quadrel {

/// The file of a scene: a path as it is, a bare name looked up in the data directories. Throws
/// InputError for a name that no installed scene has.
std::filesystem::path find_scene(const std::filesystem::path& file_or_name);

/// The comment that a scene's text begins with, in one line: lines that begin with `mark`.
std::string leading_comment(std::string_view text, std::string_view mark);

}  // namespace quadrel
