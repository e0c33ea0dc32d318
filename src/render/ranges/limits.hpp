// What an interface's specification permits an implementation, as an error budget.
#pragma once

#include <string>

#include "quadrel/num/range/error_budget.hpp"

namespace quadrel {

/// `text`: vulkan, d3d, gl or webgpu, and after it settings of what no specification states, as in
/// "gl,plane=1e-6". Throws UsageError.
ErrorBudget budget_of_limits(const std::string& text);

/// The interface that it names, without settings.
std::string interface_of_limits(const std::string& text);

}  // namespace quadrel
