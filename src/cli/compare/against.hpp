// --against oracle: an image of a scene, judged by the truth instead of by a second image.
#pragma once

#include <string>
#include <vector>

#include "cli/compare/arguments.hpp"
#include "quadrel/error.hpp"
#include "quadrel/texture/selection.hpp"

namespace quadrel::cli {

struct AgainstArguments {
    std::string scene, image, channels, window;
    std::vector<std::string> mappings, overrides, plugins;
    ToleranceArguments tolerances;  ///< of err.* channels by name: --abs, --fraction
    ImageSelection selection;
    bool flip_y = false, json = false;
};

/// Prints the errors of the image against the first hits of the scene, which is taken in the
/// image's size. A difference where an error leaves its tolerance. Throws UsageError and InputError
/// as compare does.
ExitCode run_against(const AgainstArguments& arguments);

}  // namespace quadrel::cli
