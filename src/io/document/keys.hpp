// The one table of the scene format's keys.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace quadrel {

/// What stands below a key.
enum class Below {
    value,   ///< a plain value
    object,  ///< an object of section `section` (or a plain value in its place)
    list,    ///< an array of objects of that section
    names,   ///< an object of freely named objects of that section
};

/// A key that the format knows, and what the reference (data/scenes/README.md) and `explain` say of
/// it, in Markdown.
struct SceneKey {
    std::string_view section;  ///< the kind of object that has the key
    std::string_view key;
    std::string_view value;     ///< what may stand there
    std::string_view standard;  ///< what holds where it is absent; may be empty
    std::string_view meaning;   ///< may be empty
    Below below = Below::value;
    std::string_view below_section = {};
};

/// By sections, in the order of the reference.
std::span<const SceneKey> scene_keys();

/// The row of a key; null if the section does not know it.
const SceneKey* find_scene_key(std::string_view section, std::string_view key);

/// The keys of a section.
std::vector<std::string_view> keys_of_section(std::string_view section);

/// Whether objects of the section take further keys: the parameters of stages.
bool takes_parameters(std::string_view section);

}  // namespace quadrel
