// The documentation of whatever has a name on the command line, from the tables that check it.
#pragma once

#include <string>
#include <vector>

namespace quadrel::cli {

/// Everything that `word` names, a text of some lines each: scene keys (by their path, as in -D,
/// by section and key, or by the key alone), parameters, channels and groups of them, stages,
/// presets, kinds of baked maps, exit codes. Empty if it names nothing.
std::vector<std::string> explanations(const std::string& word);

/// All names, for finding the nearest to one that is unknown.
std::vector<std::string> explained_names();

}  // namespace quadrel::cli
