// --inject: values of an image in the place of a stage's own.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "quadrel/render.hpp"

namespace quadrel::cli {

/// Adds --inject NAME=FILE, repeatable.
void add_inject_option(CLI::App& verb, std::vector<std::string>& options);

/// Reads the images, each once. Throws UsageError for what is no NAME=FILE, InputError as read_exr
/// does.
std::vector<Injection> read_injections(const std::vector<std::string>& options);

}  // namespace quadrel::cli
