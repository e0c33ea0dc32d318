// A command line that is being typed, as far as it says what comes next.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace quadrel::cli {

struct TypedLine {
    const CLI::App* at = nullptr;         ///< the last verb that is known, or the program
    const CLI::Option* option = nullptr;  ///< whose value the last word is, or goes on being
    std::string begun;                    ///< what has been typed of it
    std::string before;        ///< of the last word in front of `begun`: "--size=", "-D", nothing
    bool only_values = false;  ///< behind "--"
    std::vector<std::string> positional;  ///< words before the last that are no option's
    std::vector<std::string> defines;     ///< values of -D
};

/// Null where the verb has no such option; "--name" or "-n".
const CLI::Option* find_option(const CLI::App& verb, const std::string& name);

bool takes_value(const CLI::Option& option);

/// `words` as complete() has them.
TypedLine read_line(const CLI::App& program, const std::vector<std::string>& words);

}  // namespace quadrel::cli
