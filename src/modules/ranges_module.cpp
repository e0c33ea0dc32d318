// Stages on ranges: compiled once, for no instruction set in particular.
#include "kernels/range_stages.hpp"
#include "kernels/ranges.hpp"

namespace quadrel {
namespace {

void ends(const void* values, std::int32_t lane, double* low, double* high) {
    const RealInterval range = static_cast<const Ranged*>(values)[lane].range();
    *low = range.lo;
    *high = range.hi;
}

template <class... S>
const RangeTable& table_of(StageList<S...>) {
    static const KernelRow rows[] = {{S::text.id, &run_stage<S, Ranges>}...};
    static const RangeTable table{kernel_magic,
                                  kernel_abi_version,
                                  sizeof(Ranged),
                                  sizeof(RangeContext),
                                  rows,
                                  sizeof...(S),
                                  [] { return &range_context(); },
                                  &ends};
    return table;
}

}  // namespace
}  // namespace quadrel

extern "C" __attribute__((visibility("default"))) const quadrel::RangeTable* quadrel_range_table() {
    return &quadrel::table_of(quadrel::RangeStages());
}
