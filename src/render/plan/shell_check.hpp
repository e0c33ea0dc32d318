// What a shell over a mesh asks of its material.
#pragma once

#include <string_view>

#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// Throws an InputError that names the key of what frame-shell cannot do, or of what goes with
/// nothing but frame-shell.
void check_shell(const Scene& scene, const Material& material);

/// Whether a stage draws shells over meshes: frame and search go together there, and with no
/// others.
bool is_of_shells(std::string_view stage);

}  // namespace quadrel
