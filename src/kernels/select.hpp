// Which kernels run: the instruction sets that this CPU and this installation have.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernels/table.hpp"

namespace quadrel {

/// Whether this CPU has everything that a module of that name was compiled for.
bool cpu_supports(std::string_view isa);

/// Names of the lane sets, widest first: avx512, avx2, sse4, neon, scalar.
const std::vector<std::string>& isa_names();

/// The kernels for `number` (float | double) and `isa` (auto or a name of isa_names; only scalar
/// for double). A module is loaded when first asked for and stays. `auto` takes the widest lane set
/// that the CPU supports and whose module is installed. Throws UsageError for what is unknown,
/// unsupported by the CPU, missing, or of another version.
const KernelTable& select_kernels(const std::string& number, const std::string& isa);

}  // namespace quadrel
