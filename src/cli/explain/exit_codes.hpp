// The exit codes of the command line and what they mean: for help, `explain` and the README.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace quadrel::cli {

struct ExitCodeText {
    int code;
    std::string_view meaning;  ///< in Markdown
};

/// In rising order.
std::span<const ExitCodeText> exit_codes();

/// All of them in a few lines, for the end of the help text.
std::string exit_code_help();

}  // namespace quadrel::cli
