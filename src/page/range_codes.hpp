// Bounds of values as small numbers for a page: how far each lies from its value.
// data/page/sources.js undoes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrel::page {

enum class RangeEnd { low, high };

/// A word for each float's bound, both by their bits: the number of floats between them, rounded
/// outwards by 1/8 at most. NaN stays NaN, and what is infinite infinite. Of values that are NaN
/// bounds count from 0.
std::vector<std::uint32_t> range_codes(std::span<const float> values, std::span<const float> bounds,
                                       RangeEnd end);

/// The bounds that a page makes of them.
std::vector<float> bounds_of_codes(std::span<const float> values,
                                   std::span<const std::uint32_t> codes, RangeEnd end);

}  // namespace quadrel::page
