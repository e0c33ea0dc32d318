// What tests of ranges share.
#pragma once

#include "quadrel/num/range/error_budget.hpp"

namespace quadrel::num_tests {

/// The errors that graphics interfaces permit, or nearly.
inline ErrorBudget gpu_like() {
    ErrorBudget budget;
    budget.unit = 0x1p-23;
    budget.division = 2.5;
    budget.inverse_root = 2;
    budget.square_root = 4.5;
    budget.normalize = 7;
    budget.exp2 = budget.exp = 3;
    budget.exp2_slope = budget.exp_slope = 2;
    budget.log2 = budget.log = 3;
    budget.log2_absolute = 0x1p-21;
    budget.sine = 0x1p-11;
    budget.sine_limit = 3.15;
    budget.arctangent = 4096;
    budget.flushes_denormals = true;
    budget.derivatives = DerivativeFreedom::each;
    return budget;
}

}  // namespace quadrel::num_tests
