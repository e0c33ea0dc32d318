#include "io/document/stage_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quadrel/relief/registry.hpp"
#include "text/suggest.hpp"

namespace quadrel {

const ParameterText* find_parameter(std::string_view stage, std::string_view name) {
    const StageInfo* info = find_stage(stage);
    if (info == nullptr) return nullptr;
    for (const ParameterText& parameter : info->parameters)
        if (name == parameter.name) return &parameter;
    return nullptr;
}

bool is_parameter(std::string_view name) {
    return std::ranges::any_of(all_stages(), [&](const StageInfo& stage) {
        return find_parameter(stage.text.id, name) != nullptr;
    });
}

std::optional<double> number_of(const ParameterText& parameter, const ParameterValue& value) {
    if (const std::string* name = value.name()) {
        for (const ValueName& row : value_names(parameter))
            if (*name == row.name) return row.value;
        return std::nullopt;
    }
    const double number = *value.number();
    const bool whole = !parameter.integer || number == std::floor(number);
    const bool inside = number >= parameter.minimum && number <= parameter.maximum;
    return inside && whole ? std::optional(number) : std::nullopt;
}

std::string expected_of(const ParameterText& parameter, const ParameterValue& given) {
    std::vector<std::string> names, numbered;
    for (const ValueName& row : value_names(parameter)) {
        names.emplace_back(row.name);
        numbered.push_back(fmt::format("{} {}", row.value, row.name));
    }
    if (names.empty())
        return fmt::format("{} in [{}, {}]", parameter.integer ? "an integer" : "a number",
                           parameter.minimum, parameter.maximum);
    return given.name() ? one_of(*given.name(), names)
                        : fmt::format("one of {}", fmt::join(numbered, ", "));
}

std::string text_of(const ParameterValue& value) {
    return value.name() ? *value.name() : fmt::format("{}", *value.number());
}

}  // namespace quadrel
