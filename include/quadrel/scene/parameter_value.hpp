// What a scene gives for a stage's parameter.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace quadrel {

/// A number, or the name of one (quad/parameter.hpp).
class ParameterValue {
  public:
    ParameterValue() = default;
    template <class N>
    requires std::is_arithmetic_v<N> ParameterValue(N number)
        : value_(static_cast<double>(number)) {}
    ParameterValue(std::string name) : value_(std::move(name)) {}
    ParameterValue(const char* name) : value_(std::string(name)) {}

    /// Null where it is the other.
    const double* number() const { return std::get_if<double>(&value_); }
    const std::string* name() const { return std::get_if<std::string>(&value_); }
    bool operator==(const ParameterValue&) const = default;

  private:
    std::variant<double, std::string> value_ = 0.0;
};

}  // namespace quadrel
