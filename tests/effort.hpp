// How much of a random test is run.
#pragma once

#include <algorithm>

namespace quadrel::test {

#ifdef __SANITIZE_ADDRESS__
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// `all` rounds, or an eighth under the sanitizers, which make each many times as long and find
/// what they look for in the first.
constexpr int rounds(int all) { return sanitized ? std::max(all / 8, 1) : all; }

/// Of rows that run the same code in turn, under the sanitizers every third.
constexpr bool is_tried(int row) { return !sanitized || row % 3 == 0; }

}  // namespace quadrel::test
