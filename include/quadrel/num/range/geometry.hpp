// Vectors and differences of ranges, where the texts of num/ would forget what they know.
#pragma once

#include "quadrel/num/derivative.hpp"
#include "quadrel/num/geometric.hpp"
#include "quadrel/num/range/ranges.hpp"

namespace quadrel {

// A unit vector's components carry its number, so that dot products and reflections of unit vectors
// are known to be no longer than 1, whatever the ranges of the components would allow. Numbers from
// normalize are even and good to 2^-19; those of reflections are odd, and good to 2^-16.
namespace range_detail {

inline constexpr double longest_unit = 1 + 0x1p-16;

inline std::int32_t next_unit(bool reflected) {
    const std::int32_t n = ++range_context().unit_vectors;
    return 8 * n + (reflected ? 4 : 0);
}
/// The number of the unit vector that a lane of v is; 0 if it is none.
inline std::int32_t unit_of(const vec3<Ranges>& v, int lane) {
    const std::int32_t first = v[0].lane[lane].unit & ~3;
    std::int32_t seen = 0;
    for (int c = 0; c < 3; ++c) {
        const std::int32_t unit = v[c].lane[lane].unit;
        if (unit == 0 || (unit & ~3) != first) return 0;
        seen |= 1 << (unit & 3);
    }
    return seen == 7 ? first : 0;
}
inline bool is_normalized(std::int32_t unit) { return unit != 0 && (unit & 4) == 0; }

/// a range of something that is within +-most.
inline Ranged bounded_by(const Ranged& a, double most) {
    if (!a.is_bounded()) return {-most, most};
    const RealInterval x = a.range();
    return {std::clamp(x.lo, -most, most), std::clamp(x.hi, -most, most)};
}

}  // namespace range_detail

/// Of unit vectors, a cosine.
inline Ranges dot(const vec3<Ranges>& a, const vec3<Ranges>& b) {
    using namespace range_detail;
    Ranges sum = a.x * b.x + a.y * b.y + a.z * b.z;
    for (int i = 0; i < 4; ++i)
        if (unit_of(a, i) != 0 && unit_of(b, i) != 0) {
            const RealInterval x = sum.lane[i].range();
            if (std::max(-x.lo, x.hi) > longest_unit * longest_unit)
                sum.lane[i] = bounded_by(sum.lane[i], longest_unit * longest_unit);
        }
    return sum;
}
/// Of unit vectors, one.
inline vec3<Ranges> reflect(const vec3<Ranges>& i, const vec3<Ranges>& n) {
    using namespace range_detail;
    vec3<Ranges> result = i - n * (dot(n, i) * Ranges(2));
    for (int lane = 0; lane < 4; ++lane) {
        const std::int32_t unit = next_unit(true);
        if (!is_normalized(unit_of(i, lane)) || !is_normalized(unit_of(n, lane))) continue;
        for (int c = 0; c < 3; ++c) {
            Ranged& component = result[c].lane[lane];
            component = bounded_by(component, longest_unit);
            component.unit = unit + c;
        }
    }
    return result;
}

namespace range_detail {

/// x / root(x^2 + y) for x of a range and y of one that is not below 0: it grows with x, and comes
/// nearer to 0 as y grows.
inline RealInterval over_length(const RealInterval& x, const RealInterval& others) {
    const auto at = [&](double part, bool least) {
        const double other = (part >= 0) == least ? others.hi : others.lo;
        const double length = std::sqrt(part * part + other);
        return length > 0 ? part / length : part;
    };
    return near(at(x.lo, true), at(x.hi, false));
}

}  // namespace range_detail

/// v over its length, or times the inverse root of its square: no component is above 1 by more than
/// errors. Of what may be a null vector, anything.
template <int size>
vec<size, Ranges> normalize(const vec<size, Ranges>& v) {
    const ErrorBudget& errors = range_context().budget;
    vec<size, Ranges> result;
    for (int i = 0; i < 4; ++i) {
        const std::int32_t number = range_detail::next_unit(false);
        Ranged square(0), others[size];
        for (int c = 0; c < size; ++c) others[c] = 0;
        for (int c = 0; c < size; ++c) {
            const Ranged size_of = abs(v[c].lane[i]), of_component = size_of * size_of;
            square = square + of_component;
            for (int other = 0; other < size; ++other)
                if (other != c) others[other] = others[other] + of_component;
        }
        const RealInterval sum = square.range();
        const bool known = square.is_bounded() && sum.lo > 0x1p-100 && sum.hi < 0x1p100;
        for (int c = 0; c < size; ++c) {
            Ranged& component = result[c].lane[i];
            component = Ranged::anything();
            if (!known) continue;
            const RealInterval rest = others[c].range();
            const RealInterval unit = range_detail::rounded(
                range_detail::over_length(v[c].lane[i].range(), {std::max(rest.lo, 0.0), rest.hi}),
                errors.normalize + (errors.unit > 0 ? 2 : 0));  // of the square's sum
            const double most = 1 + (errors.normalize + 8) * 0x1p-23;
            component = Ranged(std::max(unit.lo, -most), std::min(unit.hi, most));
            if (size == 3) component.unit = number + c;
        }
    }
    return result;
}

namespace range_detail {
/// to - from, rounded once; a difference of lanes is no sum that could be taken in another order.
inline Ranged difference(const Ranged& to, const Ranged& from) { return (to - from).range(); }

/// Differences along an axis: `step` is the neighbour's distance. Where an implementation chooses,
/// those of the row (or column) that the context says, or of both.
inline Ranges differences(const Ranges& v, int step, DerivativeMode mode) {
    const RangeContext& context = range_context();
    const Ranged first = difference(v.lane[step], v.lane[0]);
    const Ranged second = difference(v.lane[3], v.lane[3 - step]);
    Ranges result;
    if (context.budget.derivatives == DerivativeFreedom::exact) {
        const bool coarse = mode == DerivativeMode::coarse;
        for (int i = 0; i < 4; ++i) result.lane[i] = coarse || (i & ~step) == 0 ? first : second;
    } else if (context.row_and_column >= 0) {
        const int bit = step == 1 ? 1 : 2;
        result = Ranges((context.row_and_column & bit) != 0 ? second : first);
    } else {
        result = Ranges(join(first, second));
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
