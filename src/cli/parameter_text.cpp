#include "cli/parameter_text.hpp"

#include <fmt/format.h>

#include <string_view>

namespace quadrel::cli {

std::string parameter_text(const ParameterText& p) {
    const std::string_view unit = p.unit == std::string_view("1") ? "" : p.unit;  // a pure number
    return fmt::format("{} = {} ({} to {}{}{}): {}", p.name, p.default_value, p.minimum, p.maximum,
                       unit.empty() ? "" : " ", unit, p.meaning);
}

}  // namespace quadrel::cli
