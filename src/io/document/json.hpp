// A JSON text with comments, read strictly: duplicate keys are errors, and every key remembers
// where it stands, for messages.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace quadrel {

/// Members keep the order of the file ("the first material" means the first one written).
using Json = nlohmann::ordered_json;

/// A place in a text; both count from 1, 0 means unknown.
struct TextPosition {
    int line = 0, column = 0;
};

/// A scene file before it is understood.
struct SceneDocument {
    std::filesystem::path file;
    Json root;
    std::map<std::string, TextPosition> positions;  ///< of keys and of objects in arrays, by path
    std::set<std::string> overridden;               ///< paths set from the command line

    /// The position of the nearest enclosing key that is known.
    TextPosition position_of(std::string path) const;
    /// Whether the value at `path` is one from the command line, or lies within one.
    bool set_by_option(const std::string& path) const;
};

/// "path.key"; just "key" at the root.
std::string join_key(const std::string& path, std::string_view key);
/// "path[index]".
std::string join_index(const std::string& path, std::size_t index);

/// Parses `text`. Throws InputError with line and column for a syntax error or a duplicate key.
SceneDocument parse_scene_text(std::string_view text, const std::filesystem::path& file);

/// A value of the command line: JSON, or where it is none the text itself, a string. Throws
/// InputError for a bracket with NaN, an infinity, a number beyond double or a key twice in it;
/// the error's key is the place within the value.
Json parse_option_value(std::string_view text);

}  // namespace quadrel
