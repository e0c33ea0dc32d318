// --layer and --part, wherever a verb reads an image.
#pragma once

#include <CLI/App.hpp>

#include "quadrel/texture/selection.hpp"

namespace quadrel::cli {

/// `prefix` distinguishes the options of a verb's other image: "reference-".
void add_selection_options(CLI::App& verb, ImageSelection& selection,
                           const std::string& prefix = "", const std::string& what = "an EXR");

}  // namespace quadrel::cli
