// Parts of a ray, and what is proven of the field over each. The field less the ray's height,
// F(s) = height(s) - z(s), is along a piece q(tau) = A tau^2 + B tau + C, tau = s - from.
#pragma once

#include "relief/oracle/piece.hpp"

namespace quadrel::oracle {

/// s in [from, to], in one piece, or where rounding leaves open which of several it is in.
struct Segment {
    static constexpr int most_pieces = 16;

    double from, to;
    std::array<Piece<Interval>, most_pieces> pieces;
    int count = 0;
    int last = -1;         ///< the piece at `to`; -1: open
    bool complete = true;  ///< `pieces` are all
};

/// A bracket of the first hit: F < 0 up to `lo` (at `lo` too, unless it is 0 or hi), F >= 0 at a
/// point in [lo, hi].
struct Bracket {
    double lo, hi, s;
};

class PieceRay {
  public:
    PieceRay(const GridRay& ray, const Piece<Interval>& piece)
        : ray_(ray),
          piece_(piece),
          f_(ray.x.position - static_cast<double>(piece.i)),
          g_(ray.y.position - static_cast<double>(piece.j)) {}

    /// F.
    Interval above(double s) const { return piece_.height(f_.at(s), g_.at(s)) - ray_.z.at(s); }
    /// dF / ds.
    Interval slope(double s) const {
        return (piece_.b + piece_.d * g_.at(s)) * f_.rate +
               (piece_.c + piece_.d * f_.at(s)) * g_.rate - Interval(ray_.z.climb);
    }
    Interval curvature() const { return piece_.d * f_.rate * g_.rate; }

    /// No less than the greatest F in [from, to].
    double upper_bound(double from, double to) const;
    /// Where F, below 0 at `from`, first comes up to 0: as double finds it, at most `to`.
    double guess(double from, double to) const;
    /// A bracket of the first root in [from, to]; false if rounding leaves it open whether there is
    /// one. `reaches_floor`: the ray ends at `to`, where heights that are not negative have met it.
    bool bracket(double from, double to, bool reaches_floor, Bracket& found) const;

    const Piece<Interval>& piece() const { return piece_; }
    Interval f(double s) const { return f_.at(s); }
    Interval g(double s) const { return g_.at(s); }

  private:
    const GridRay& ray_;
    const Piece<Interval>& piece_;
    Affine f_, g_;
};

}  // namespace quadrel::oracle
