#include "render/lists/parameter_text.hpp"

#include <fmt/format.h>

#include <string_view>

namespace quadrel {
namespace {

std::string choice_text(const ParameterText& p) {
    std::string names;
    for (const ValueName& row : value_names(p))
        names += fmt::format("{}{} {}", names.empty() ? "" : ", ", row.value, row.name);
    const std::string_view name = name_of_value(p, p.default_value);
    return fmt::format("{} = {} ({}): {}", p.name,
                       name.empty() ? fmt::format("{}", p.default_value) : name, names, p.meaning);
}

}  // namespace

std::string parameter_text(const ParameterText& p) {
    if (!value_names(p).empty()) return choice_text(p);
    const std::string_view unit = p.unit == std::string_view("1") ? "" : p.unit;  // a pure number
    return fmt::format("{} = {} ({} to {}{}{}): {}", p.name, p.default_value, p.minimum, p.maximum,
                       unit.empty() ? "" : " ", unit, p.meaning);
}

}  // namespace quadrel
