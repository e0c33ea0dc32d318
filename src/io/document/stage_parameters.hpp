// Values of stages' parameters: what they mean, and what to say of those that mean nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "quadrel/quad/parameter.hpp"
#include "quadrel/scene/parameter_value.hpp"

namespace quadrel {

/// The parameter of that name of a stage; null where there is none, or no such stage.
const ParameterText* find_parameter(std::string_view stage, std::string_view name);

/// Whether any stage has a parameter of that name.
bool is_parameter(std::string_view name);

/// The number that the value stands for; none where the parameter does not take it.
std::optional<double> number_of(const ParameterText& parameter, const ParameterValue& value);

/// What the parameter takes, the name nearest to the given one first.
std::string expected_of(const ParameterText& parameter, const ParameterValue& given);

/// "0.5", or "steep".
std::string text_of(const ParameterValue& value);

}  // namespace quadrel
