// The rooms of searches, as charts tell them apart.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadrel::sweep {

/// "offset", "march", "cone", "exact", "layer", "curved", "table", "shell", "oracle", "engine", or
/// "other" for a plugin's.
std::string_view family_of(std::string_view trace);

/// Which rows a plan may ask for by one word.
enum class Rows {
    all,        ///< every trace
    corrected,  ///< without published defects: no "@published", nothing left out, no engine's
    published,  ///< those, and what stands for one implementation
    engines,
    oracles
};

/// Ids in the registry's order, but for searches that the judge of first hits does not know
/// (render/registry/judged_search.hpp): sweeps have height maps.
std::vector<std::string> trace_rows(Rows rows);

}  // namespace quadrel::sweep
