// Values of plans that are lists, and what they combine to.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/document/value.hpp"

namespace quadrel::sweep {

/// One value stands for an array of one.
std::vector<SceneValue> elements(const SceneValue& value);

/// The same, where what stands there twice would be measured twice.
std::vector<SceneValue> distinct_elements(const SceneValue& value);

/// As people write it: 45, 0.5.
std::string short_number(double value);

/// A string that is one of `known`.
std::string word_in(const SceneValue& value, const std::vector<std::string>& known);

/// Combinations of an entry's values.
inline constexpr std::size_t most_combinations = 10'000;

/// All combinations of `lists`' values, the last one changing quickest. Refuses `entry`, whose they
/// are, if there are too many.
template <class T>
std::vector<std::map<std::string, T>> products(
    const SceneValue& entry, const std::vector<std::pair<std::string, std::vector<T>>>& lists) {
    std::size_t count = 1;
    for (const auto& [name, values] : lists)
        if ((count *= values.size()) > most_combinations)
            entry.fail("lists with more than 10000 combinations", "at most as many");
    std::vector<std::map<std::string, T>> all{{}};
    for (const auto& [name, values] : lists) {
        std::vector<std::map<std::string, T>> next;
        for (const auto& before : all)
            for (const T& value : values) {
                next.push_back(before);
                next.back()[name] = value;
            }
        all = std::move(next);
    }
    return all;
}

}  // namespace quadrel::sweep
