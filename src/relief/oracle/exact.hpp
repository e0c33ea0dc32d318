// The same question in rational arithmetic: heights, coordinates and s are binary fractions, so
// that the sign of everything that decides is known. Slow, and asked only over the few units in the
// last place, or the one cell, that bounds in double leave open.
#pragma once

#include "relief/oracle/segment.hpp"

namespace quadrel::oracle {

enum class ExactEnd { clear, met, unavailable };

struct ExactResult {
    ExactEnd end;
    Bracket bracket;        ///< where `met`
    Piece<Interval> piece;  ///< that is met
};

/// Whether a ray that is above the field before `from` meets it in [from, to].
ExactResult search_exactly(const Field& field, const Ray& ray, double from, double to);

}  // namespace quadrel::oracle
