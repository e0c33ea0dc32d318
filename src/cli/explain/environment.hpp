// The environment variables that the command line reads: for man pages and the README.
#pragma once

#include <span>
#include <string_view>

namespace quadrel::cli {

struct EnvironmentText {
    std::string_view name;
    std::string_view meaning;  ///< in Markdown
};

std::span<const EnvironmentText> environment_variables();

}  // namespace quadrel::cli
