// What exported functions read of a shell beside values: varyings, in slots behind those of values.
#pragma once

#include <iterator>
#include <string_view>

#include "quadrel/quad/value.hpp"

namespace quadrel::export_tests {

struct ShellInput {
    const char* name;
    int components;
};
inline constexpr ShellInput shell_inputs[] = {
    {"corner_weights", 3}, {"shell_depth", 1}, {"shell_row", 1},
    {"strip_nv", 3},       {"strip_tv", 3},    {"strip_bv", 3},
    {"strip_height", 1},   {"strip_side", 1},  {"front_facing", 1}};

/// First slot of the input of that index; behind the last one of all.
constexpr int shell_slot(std::size_t input) {
    int slot = slot_count;
    for (std::size_t i = 0; i < input; ++i) slot += shell_inputs[i].components;
    return slot;
}
inline constexpr int all_slots = shell_slot(std::size(shell_inputs));

/// Index of the input of that name; behind the last one for others.
constexpr std::size_t shell_input(std::string_view name) {
    std::size_t i = 0;
    while (i < std::size(shell_inputs) && shell_inputs[i].name != name) ++i;
    return i;
}

}  // namespace quadrel::export_tests
