// The groups that kernels are compiled in: one translation unit for each number type.
#pragma once

#include "kernels/table.hpp"
#include "quadrel/quad/stage_list.hpp"

namespace quadrel {

/// Stands for a number type where groups are asked for.
template <class F>
struct NumberTag {};

/// The rows of a list of stages on one number type.
template <class F, class... S>
KernelGroup kernel_rows(StageList<S...>) {
    static const KernelRow rows[sizeof...(S) + 1] = {{S::text.id, &run_stage<S, F>}...};
    return {rows, sizeof...(S)};
}

}  // namespace quadrel
