// Assignments of -D that are being typed: keys from the table of the scene format, names and stages
// from the scene.
#pragma once

#include <string>
#include <vector>

#include "cli/shell/words.hpp"

namespace quadrel::cli {

/// What may follow `begun`, which is a part of KEY=VALUE; `before` stands in front of each word.
/// `scene`, a file or an installed scene, may be empty or nothing that can be read; `defines` are
/// the assignments before.
void add_assignments(const std::string& begun, const std::string& before, const std::string& scene,
                     const std::vector<std::string>& defines, Candidates& to);

/// KEY alone, each path whose first part is complete: "material.relief.depth".
void add_key_paths(const std::string& begun, Candidates& to);

}  // namespace quadrel::cli
