// The kernels that the instruction-set modules are measured against.
#pragma once

#include <string>
#include <vector>

#include "kernels/table.hpp"

namespace quadrel::bench {

/// Quad<float> without auto-vectorisation, compiled for `isa`; "" is plain x86-64.
/// Throws std::runtime_error where it is missing.
const KernelTable& baseline_kernels(const std::string& isa = "");

/// The lane sets that this CPU supports, narrowest first, without scalar.
std::vector<std::string> lane_sets();

}  // namespace quadrel::bench
