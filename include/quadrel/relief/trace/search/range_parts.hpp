// One of several results of a search that is not followed step by step: which, is a decision.
#pragma once

#include "quadrel/num/range/mask.hpp"
#include "quadrel/quad/promises.hpp"

namespace quadrel::range_detail {

/// More parts of s than this are taken together.
inline constexpr int most_parts = 8;
inline constexpr int most_ends = 2 * most_parts + 1;  ///< one kind of parts, another, past both

/// One of `count` in a lane: the followed one takes one after another. -1: all together.
inline int one_of_parts(int count, int lane) {
    RangeContext& context = range_context();
    if (count == 1) return 0;
    if (context.followed != lane || context.takes_together()) {
        context.join(lane);
        return -1;
    }
    const int last = count - 1;
    for (int k = 0; k < most_ends; ++k) {
        if (k == last) break;
        const std::int32_t comparison = context.leave_open();
        if (comparison < 0 || context.decide(comparison)) return k;
    }
    return last;
}

/// From one status to another.
inline RangeInt::Lane statuses(Status first, Status last) {
    return {static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)};
}

/// Of a search of which nothing is known, and of what searches count.
inline RangeInt::Lane any_status() {
    return {0, static_cast<std::int32_t>(allowed_end(Value::hit_status)) - 1};
}
inline RangeInt any_count() {
    RangeInt count;
    for (RangeInt::Lane& lane : count.lane) lane = {0, std::numeric_limits<std::int32_t>::max()};
    return count;
}
/// How it wraps or doubts.
inline RangeInt any_flags() {
    RangeInt flags;
    for (RangeInt::Lane& lane : flags.lane) lane = {0, static_cast<std::int32_t>(HitFlag::end) - 1};
    return flags;
}

}  // namespace quadrel::range_detail
