// The searches of a plan.
#pragma once

#include "io/document/value.hpp"
#include "sweep/plan/plan.hpp"

namespace quadrel::sweep {

/// What the entries of a plan stand for, each search with each set of parameters once. Throws
/// InputError.
std::vector<Algorithm> read_algorithms(const std::vector<SceneValue>& entries);

}  // namespace quadrel::sweep
