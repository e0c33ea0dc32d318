#include "sweep/plan/plan_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace quadrel::sweep {

std::vector<SceneValue> elements(const SceneValue& value) {
    if (!value.json().is_array()) return {value};
    if (value.json().empty()) value.fail("an empty array", "at least one");
    std::vector<SceneValue> all;
    for (std::size_t i = 0; i < value.json().size(); ++i) all.push_back(value.element(i));
    return all;
}

std::vector<SceneValue> distinct_elements(const SceneValue& value) {
    std::vector<SceneValue> all = elements(value);
    std::set<Json> known;
    for (const SceneValue& one : all)
        if (!known.insert(one.json()).second)
            one.fail(one.json().dump() + " a second time", "each value once");
    return all;
}

std::string short_number(double value) { return fmt::format("{:g}", value); }

std::string word_in(const SceneValue& value, const std::vector<std::string>& known) {
    const std::string word = value.string();
    if (std::find(known.begin(), known.end(), word) == known.end())
        value.reject(one_of(word, known));
    return word;
}

}  // namespace quadrel::sweep
