// What the channel `undecided` says of a pixel as a whole.
#pragma once

#include <cstdint>

namespace quadrel {

/// A bit of the channel `undecided`, beside those of Undecided (num/range/context.hpp), and the
/// only one where nothing is covered: some implementations have a fragment there and others none.
/// Part of the file format.
inline constexpr std::uint32_t undecided_presence = 64;

}  // namespace quadrel
