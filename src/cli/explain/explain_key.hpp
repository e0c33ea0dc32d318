// Scene keys and sections in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadrel::cli {

/// What the scene format means by `word`: a path as in -D, "section.key", a key, or a section.
std::vector<std::string> explain_key(const std::string& word);

/// The path of a scene key that `path` is nearly, part by part; empty if some part is near nothing.
std::string nearest_path(const std::string& path);

/// A stage's parameter as a scene names it: by a path, or by itself in any room.
struct ParameterPlace {
    std::string room;  ///< empty: any
    std::string name;
};

/// Nothing if no parameter can stand there.
std::optional<ParameterPlace> parameter_place(const std::string& path);

}  // namespace quadrel::cli
