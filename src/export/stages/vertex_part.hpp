// What a recorded text computes at the vertices, as a recording of its own.
#pragma once

#include <string>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// Moves what `graph` computes at the vertices into `vertex`, whose inputs are attributes of
/// vertices and whose outputs are inputs of `graph`, of the same names: what the text calls them,
/// each once and none of `taken`. Nothing is moved where there is nothing. Throws RecordingError
/// where something is made of what only fragments have.
void take_vertex_part(Graph& graph, Graph& vertex, const std::vector<std::string>& taken);

}  // namespace quadrel::recorded
