// Instantiates every stage on one number type.
#pragma once

#include "kernels/table.hpp"
#include "quadrel/shade/stages.hpp"

namespace quadrel {

template <class F>
struct KernelRows {
    template <class... R, class... S>
    static const KernelTable& table(const char* isa, StageList<R...>, StageList<S...>) {
        static const KernelRow rows[] = {{R::text.id, &run_stage<R, F>}...,
                                         {S::text.id, &run_stage<S, F>}...};
        static const KernelTable table{
            kernel_magic,      kernel_abi_version,          isa, lanes_of<F>,
            sizeof(Scalar<F>), sizeof...(R) + sizeof...(S), rows};
        return table;
    }
};

template <class F>
const KernelTable& kernel_table(const char* isa) {
    return KernelRows<F>::table(isa, ReliefStages(), ShadeStages());
}

}  // namespace quadrel
