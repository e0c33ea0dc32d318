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

/// The middle of a range, and what is left as the named error `part` of a group.
Ranged with_named_error(const Ranged& x, std::int32_t group, int part) {
    const RealInterval range = x.range();
    if (!x.is_bounded() || range.is_point()) return x;
    const double middle = range.middle();
    Ranged result(middle, middle);
    result.mass = range.magnitude();
    result.named = group;
    result.part[part] = next_up(std::max(range.hi - middle, middle - range.lo));
    return result;
}

void name_place(void* u, void* v) {
    RangeContext& context = range_context();
    context.places = context.shared_errors + 1;
    context.shared_errors += 4;
    for (int lane = 0; lane < 4; ++lane) {
        Ranged& x = static_cast<Ranged*>(u)[lane];
        Ranged& y = static_cast<Ranged*>(v)[lane];
        x = with_named_error(x, context.places + lane, 0);
        y = with_named_error(y, context.places + lane, 1);
    }
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
                                  &ends,
                                  &name_place};
    return table;
}

}  // namespace
}  // namespace quadrel

extern "C" __attribute__((visibility("default"))) const quadrel::RangeTable* quadrel_range_table() {
    return &quadrel::table_of(quadrel::RangeStages());
}
