// What an interface's specification permits an implementation, as an error budget.
#pragma once

#include <string>

#include "quadrel/num/range/error_budget.hpp"

namespace quadrel {

/// What differs from exact arithmetic by the rounding of float32 alone: no GPU's, but what decides
/// otherwise here could flip in the reference itself.
inline constexpr const char* limits_of_rounding = "rounding";

/// `text`: vulkan, d3d, gl, webgpu or rounding, and after it settings of what no specification
/// states, as in "gl,plane=1e-6". Throws UsageError.
ErrorBudget budget_of_limits(const std::string& text);

}  // namespace quadrel
