// The first hit, proven: F, the field less the ray's height, is shown to be below 0 over every part
// of the ray up to `lo`, and not to be at a point up to `hi`. Then the exact hit, in the cell that
// is named, lies between, whatever double rounded.
//
//   - Over nodes of the pyramid, by their greatest height (cell_walk.hpp).
//   - Over a cell, by a bound of its quadratic (segment.hpp). Where that does not go below 0, by a
//     root that double finds and the signs of F on both of its sides.
//   - Where intervals leave a sign, a cell or the side of a line open, in rationals (exact.hpp),
//     over that segment alone.
#pragma once

#include <optional>

#include "relief/oracle/exact.hpp"
#include "relief/oracle/segments.hpp"

namespace quadrel::oracle {

/// What is known of a segment.
enum class Verdict { clear, met, open };

struct Judged {
    Verdict verdict;
    Bracket bracket{};
    const Piece<Interval>* piece = nullptr;  ///< that is met
};

/// A hit at a border is known as well as that is.
inline constexpr double widest_border = 0x1p-40;

/// By intervals. `start`: nothing is known of F at its beginning; else F is below 0 there. At
/// borders that take more of the ray than `widest` nothing is met.
Judged judge(const GridRay& ray, const Segment& segment, bool start, double widest = widest_border);

}  // namespace quadrel::oracle
