// Bounds of values as small numbers for a page: how far each lies from its value.
// data/page/sources.js undoes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrel::page {

enum class RangeEnd { low, high };

/// A word for each value's bound: the distance between them in 3 bits and a power of two, in
/// proportion to the value's, rounded so that the bound moves outwards by 1/8 of it at most (and to
/// the next float). 0 is the value itself; NaN stays NaN, and what is infinite infinite. Of values
/// that are no finite numbers bounds count from 0.
std::vector<std::uint32_t> range_codes(std::span<const float> values, std::span<const float> bounds,
                                       RangeEnd end);

/// The bounds that a page makes of them.
std::vector<float> bounds_of_codes(std::span<const float> values,
                                   std::span<const std::uint32_t> codes, RangeEnd end);

}  // namespace quadrel::page
