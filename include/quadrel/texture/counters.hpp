// What a fetch is told about its lanes, and what it counts.
#pragma once

#include <cstdint>

#include "quadrel/num/functions.hpp"

namespace quadrel {

struct TexelMarks;  // marks.hpp

/// Events of texture fetches, of active lanes only. Plain data. Sums are of the counts alone.
struct FetchCounters {
    std::uint64_t fetches = 0;           ///< filtered or unfiltered look-ups, one per lane
    std::uint64_t nan_coordinates = 0;   ///< coordinates (u and v apart) that were NaN, read as 0
    std::uint64_t huge_coordinates = 0;  ///< infinite or beyond 2^23, saturated
    const TexelMarks* marks = nullptr;   ///< where the texels of look-ups are marked; null: nowhere

    FetchCounters& operator+=(const FetchCounters& other) {
        fetches += other.fetches;
        nan_coordinates += other.nan_coordinates;
        huge_coordinates += other.huge_coordinates;
        return *this;
    }
};

class FetchLog;  // fetch_log.hpp

/// The lanes that ask (helper lanes included; the others' results are unspecified but harmless),
/// and where to count. `counters` may be null, and so
/// may `log`, which receives every look-up of a quad that is being probed.
template <Number F>
struct SampleContext {
    Mask<F> active = Mask<F>(true);
    FetchCounters* counters = nullptr;
    FetchLog* log = nullptr;
};

/// How many lanes are true.
template <Number F>
std::uint64_t count_lanes(Mask<F> mask) {
    return static_cast<std::uint64_t>(count(mask));
}

template <Number F>
void count_fetch(const SampleContext<F>& context) {
    if (context.counters != nullptr) context.counters->fetches += count_lanes<F>(context.active);
}

/// Counts the active lanes whose coordinate is NaN or has a magnitude above `limit`.
template <Number F>
[[gnu::always_inline]] inline void count_coordinate(const SampleContext<F>& context, F coordinate,
                                                    F limit) {
    if (context.counters == nullptr) return;
    const Mask<F> odd = context.active & !(abs(coordinate) <= limit);
    if (when(odd)) {
        const std::uint64_t nan = count_lanes<F>(odd & is_nan(coordinate));
        context.counters->nan_coordinates += nan;
        context.counters->huge_coordinates += count_lanes<F>(odd) - nan;
    }
}

}  // namespace quadrel
