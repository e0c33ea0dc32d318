// Names for what no text has named, by what it is.
#pragma once

#include <string>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// What a node is called by the text, or as an input; "uv_x" for a component. Empty where it has no
/// name.
std::string own_name(const Node& node);

/// "floor_position", "abs_rate", "sum", "texel"; empty for literals.
std::string described(const Node& node);

}  // namespace quadrel::recorded
