// What no stage may store, whatever it computes: integers outside of these ranges.
#pragma once

#include "quadrel/quad/value.hpp"

namespace quadrel {

/// An end that negative numbers alone, read as unsigned, are not below.
inline constexpr std::uint32_t counts_end = 0x80000000u;

/// Allowed values of an integer value are [0, allowed_end), a power of two; 0 where every one is.
constexpr std::uint32_t allowed_end(Value v) {
    switch (v) {
        case Value::frame_status:
        case Value::hit_status:
            return 8;
        case Value::frame_flags:
            return 16;
        case Value::hit_flags:
            return HitFlag::end;
        case Value::hit_steps:
        case Value::hit_fetches:
        case Value::shadow_steps:
            return counts_end;
        default:
            return 0;
    }
}

}  // namespace quadrel
