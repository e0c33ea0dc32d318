// Variables of loops that are one vector's components. The objects of a text are numbers, of which
// each becomes a variable; those that are given a vector's components together are one variable
// again, so that a shader says `uv = at` where the text does.
#pragma once

#include <set>
#include <string>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// Of a graph that is not folded yet. Of outputs only `wanted` stay, or all if that is empty.
/// Vectors that are not needed as a whole stay numbers. All variables of a loop come to stand in
/// the order in which their objects were made.
void join_carried_vectors(Graph& graph, const std::set<std::string>& wanted);

}  // namespace quadrel::recorded
