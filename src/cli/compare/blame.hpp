// From a wrong pixel to the command line that shows how it came about.
#pragma once

#include <string>
#include <vector>

#include "quadrel/compare.hpp"

namespace quadrel::cli {

/// The scene that the reference was rendered from, as the user names it.
struct ProbedScene {
    std::string name;
    std::vector<std::string> overrides;
    std::vector<std::string> plugins;  ///< files with stages that it names
};

/// Throws InputError if the scene cannot be loaded, whatever the images hold.
ProbedScene open_probed_scene(const std::string& name, const std::vector<std::string>& overrides);

/// Fills in the `quadrel probe` line, with the reference's size, and whether the scene recorded in
/// the reference, if any, is this one.
void point_at_probe(Blame& blame, const ProbedScene& scene, const ComparableImage& reference);

}  // namespace quadrel::cli
