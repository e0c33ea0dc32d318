// What a shell over a mesh asks of its material.
#pragma once

#include <string_view>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Throws an InputError that names the key of what a shell cannot do, or of what goes with nothing
/// but a shell.
void check_shell(const Scene& scene, const Material& material);

/// Whether a stage draws shells over meshes: frame and search go together there, and with no
/// others.
bool is_of_shells(std::string_view stage);

/// The frame that goes with a search of shells; empty for other searches.
std::string_view frame_of_search(std::string_view trace);

}  // namespace quadrel
