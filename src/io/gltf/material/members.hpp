// Members of JSON that may be missing or of another kind.
#pragma once

#include <nlohmann/json.hpp>

namespace quadrel {

/// Null where there is none.
inline const nlohmann::json& member_of(const nlohmann::json& object, const char* key) {
    static const nlohmann::json none;
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

/// The element of the list of this name that an index names; null where there is none.
inline const nlohmann::json& element(const nlohmann::json& root, const char* list,
                                     const nlohmann::json& index) {
    static const nlohmann::json none;
    const nlohmann::json& all = member_of(root, list);
    if (!all.is_array() || !index.is_number_unsigned()) return none;
    const auto i = index.get<std::size_t>();
    return i < all.size() ? all[i] : none;
}

}  // namespace quadrel
