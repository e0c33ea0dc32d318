// Vectors and differences of ranges, where the texts of num/ would forget what they know.
#pragma once

#include "quadrel/num/derivative.hpp"
#include "quadrel/num/geometric.hpp"
#include "quadrel/num/range/ranges.hpp"

namespace quadrel {

/// v over its length, or times the inverse root of its square: no component is above 1 by more than
/// errors. Of what may be a null vector, anything.
template <int size>
vec<size, Ranges> normalize(const vec<size, Ranges>& v) {
    const ErrorBudget& errors = range_context().budget;
    vec<size, Ranges> result;
    for (int i = 0; i < 4; ++i) {
        Ranged square(0);
        for (int c = 0; c < size; ++c) {
            const Ranged size_of = abs(v[c].lane[i]);
            square = square + size_of * size_of;
        }
        const RealInterval sum = square.range();
        const bool known = square.is_bounded() && sum.lo > 0x1p-100 && sum.hi < 0x1p100;
        for (int c = 0; c < size; ++c) {
            Ranged& component = result[c].lane[i];
            component = Ranged::anything();
            if (!known) continue;
            const RealInterval root(next_down(std::sqrt(sum.lo)), next_up(std::sqrt(sum.hi)));
            const RealInterval unit =
                range_detail::rounded(v[c].lane[i].range() / root, errors.normalize);
            const double most = 1 + (errors.normalize + 8) * 0x1p-23;
            component = Ranged(std::max(unit.lo, -most), std::min(unit.hi, most));
        }
    }
    return result;
}

namespace range_detail {
/// to - from, rounded once; a difference of lanes is no sum that could be taken in another order.
inline Ranged difference(const Ranged& to, const Ranged& from) { return (to - from).range(); }

/// Differences along an axis: `step` is the neighbour's distance, `first` the lane of the quad that
/// a coarse one starts from.
inline Ranges differences(const Ranges& v, int step, DerivativeMode mode) {
    const bool any_mode = range_context().budget.any_derivative;
    const Ranged coarse = difference(v.lane[step], v.lane[0]);
    Ranges result;
    for (int i = 0; i < 4; ++i) {
        const int from = i & ~step;
        const Ranged fine = difference(v.lane[from + step], v.lane[from]);
        result.lane[i] = mode == DerivativeMode::coarse ? coarse : fine;
        if (any_mode) result.lane[i] = join(fine, coarse);
    }
    return result;
}
}  // namespace range_detail

inline Ranges dFdx(const Ranges& v, DerivativeMode mode = DerivativeMode::fine) {
    return range_detail::differences(v, 1, mode);
}
inline Ranges dFdy(const Ranges& v, DerivativeMode mode = DerivativeMode::fine) {
    return range_detail::differences(v, 2, mode);
}

}  // namespace quadrel
