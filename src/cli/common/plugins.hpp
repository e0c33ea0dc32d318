// --plugin: stages of the user's own.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace quadrel::cli {

/// Adds --plugin FILE, repeatable.
void add_plugin_option(CLI::App& verb, std::vector<std::string>& files);

/// Loads them in the order given. Throws as load_plugin does.
void load_plugins(const std::vector<std::string>& files);

}  // namespace quadrel::cli
