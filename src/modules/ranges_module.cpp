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

/// Either of two unit vectors is one.
Ranged joined(const Ranged& a, const Ranged& b) {
    constexpr std::int32_t component_and_kind = 7;
    const RealInterval x = a.range(), y = b.range();
    if (x.lo == y.lo && x.hi == y.hi) return a;
    Ranged result = join(a, b);
    const bool both_unit = a.unit != 0 && b.unit != 0;
    if (both_unit && ((a.unit ^ b.unit) & component_and_kind) == 0) result.unit = a.unit;
    return result;
}

void join_values(void* values, const void* others) {
    auto* const to = static_cast<Ranged*>(values);
    for (int lane = 0; lane < 4; ++lane)
        to[lane] = joined(to[lane], static_cast<const Ranged*>(others)[lane]);
}

/// With what the second one has beside its ends.
Ranged narrowed(const Ranged& a, const Ranged& b) {
    const RealInterval x = a.range(), y = b.range();
    if ((x.lo <= y.lo && y.hi <= x.hi) || x.hi < y.lo || y.hi < x.lo) return b;
    Ranged result(std::max(x.lo, y.lo), std::min(x.hi, y.hi));
    result.unit = b.unit;
    return result;
}

void narrow_value(void* values, const void* others, std::int32_t lane) {
    Ranged& value = static_cast<Ranged*>(values)[lane];
    value = narrowed(value, static_cast<const Ranged*>(others)[lane]);
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
                                  range_abi_version,
                                  sizeof(Ranged),
                                  sizeof(RangeContext),
                                  rows,
                                  sizeof...(S),
                                  [] { return &range_context(); },
                                  &ends,
                                  &join_values,
                                  &narrow_value,
                                  &name_place};
    return table;
}

}  // namespace
}  // namespace quadrel

extern "C" __attribute__((visibility("default"))) const quadrel::RangeTable* quadrel_range_table() {
    return &quadrel::table_of(quadrel::RangeStages());
}
