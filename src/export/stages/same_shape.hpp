// Recordings of one text with other parameters: whether they differ in literals alone.
#pragma once

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// Whether node by node and event by event both have done the same, with what literals ever.
bool have_same_shape(const Graph& a, const Graph& b);
/// Whether they are of the same shape and all literals are equal, too.
bool are_equal(const Graph& a, const Graph& b);
bool have_same_value(const Node& a, const Node& b);

}  // namespace quadrel::recorded
