#include "io/document/keys.hpp"

namespace quadrel {

const SceneKey* find_scene_key(std::string_view section, std::string_view key) {
    for (const SceneKey& row : scene_keys())
        if (row.section == section && row.key == key) return &row;
    return nullptr;
}

std::vector<std::string_view> keys_of_section(std::string_view section) {
    std::vector<std::string_view> found;
    for (const SceneKey& row : scene_keys())
        if (row.section == section) found.push_back(row.key);
    return found;
}

bool takes_parameters(std::string_view section) {
    return section == "relief" || section == "stage";
}

}  // namespace quadrel
