#include "io/document/keys.hpp"
#include "io/document/override.hpp"
#include "io/document/stage_parameters.hpp"
#include "io/document/value.hpp"

namespace quadrel {
namespace {

void check_section(const SceneValue& value, std::string_view section);

/// Where stages have their parameters, a name that is near no key is one of these.
[[noreturn]] void refuse_key(const SceneValue& value, const std::string& key,
                             std::string_view section) {
    const std::vector<std::string_view> known = keys_of_section(section);
    if (takes_parameters(section) && nearest_word(key, known).empty())
        value.reject("a number or a name, as parameters of stages are, or another key: " +
                     one_of(key, known));
    value.fail("an unknown key", one_of(key, known));
}

void check_below(const SceneValue& value, const SceneKey& row) {
    const Json& json = value.json();
    if (row.below == Below::object) check_section(value, row.below_section);
    if (row.below == Below::list && json.is_array())
        for (std::size_t i = 0; i < json.size(); ++i)
            check_section(value.element(i), row.below_section);
    if (row.below == Below::names && json.is_object())
        for (const auto& [name, member] : json.items())
            check_section(value.member(name), row.below_section);
}

// Values that are not objects are left to whoever reads them.
void check_section(const SceneValue& value, std::string_view section) {
    if (!value.json().is_object()) return;
    for (const auto& [key, member] : value.json().items()) {
        const SceneValue here = value.member(key);
        if (const SceneKey* row = find_scene_key(section, key))
            check_below(here, *row);
        else if (!(takes_parameters(section) && (member.is_number() || is_parameter(key))))
            refuse_key(here, key, section);
    }
}

}  // namespace

void check_scene_keys(const SceneDocument& document) {
    const SceneValue root(document, document.root, "");
    if (!root.json().is_object()) root.reject("a scene: an object { \"quadrel\": 1, ... }");
    if (root.json().empty()) root.fail("an empty object", "the first key to be \"quadrel\"");
    const std::string first = root.json().begin().key();
    if (first != "quadrel")
        root.member(first).fail("\"" + first + "\" as the first key",
                                "\"quadrel\": 1, the format's version, first");
    root.member("quadrel").integer(1, 1);
    check_section(root, "scene");
}

}  // namespace quadrel
