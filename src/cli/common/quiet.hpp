// --quiet: nothing on standard error but errors and warnings.
#pragma once

#include <CLI/App.hpp>
#include <string_view>

namespace quadrel::cli {

/// Adds --quiet, which holds for the whole process.
void add_quiet_option(CLI::App& verb);

/// Whether it was given.
bool is_quiet();

/// A line for people that nobody needs, on standard error unless --quiet.
void tell(std::string_view line);

}  // namespace quadrel::cli
