#include "relief/oracle/segment.hpp"

namespace quadrel::oracle {

/// By a tangent: where q is concave it lies below each of its tangents, else below by no more than
/// A length^2, and a convex q is greatest at an end.
double PieceRay::upper_bound(double from, double to) const {
    const Interval A = curvature();
    if (A.lo >= 0) return std::max(above(from).hi, above(to).hi);
    const double vertex = from - slope(from).middle() / (2 * A.middle());
    const double at = vertex > from ? std::min(vertex, to) : from;
    const Interval rises = slope(at);
    const Interval ahead = Interval(to) - at, behind = Interval(at) - from;
    const double gain =
        std::max({0.0, (Interval(rises.hi) * ahead).hi, (Interval(-rises.lo) * behind).hi});
    const Interval length = Interval(to) - from;
    const Interval bend = Interval(std::max(A.hi, 0.0)) * length * length;
    return (Interval(above(at).hi) + Interval(gain) + bend).hi;
}

double PieceRay::guess(double from, double to) const {
    const double A = curvature().middle(), B = slope(from).middle(), C = above(from).middle();
    const double root = std::sqrt(std::max(B * B - 4 * A * C, 0.0));
    const double tau = A > 0 && B < 0 ? (root - B) / (2 * A) : -2 * C / (B + root);
    const double s = from + tau;
    return s >= from ? std::min(s, to) : to;
}

bool PieceRay::bracket(double from, double to, bool reaches_floor, Bracket& found) const {
    const double s = guess(from, to), unit = up(s) - s;
    const bool met_at_end = reaches_floor && piece_.least >= 0;
    double hi = s;
    for (double step = unit; !(above(hi).lo >= 0); step *= 4) {
        if (hi >= to && met_at_end) break;
        if (hi >= to) return false;
        hi = std::min(to, s + step);
    }
    double lo = std::max(from, down(s));
    for (double step = unit; lo > from && !(upper_bound(from, lo) < 0); step *= 4)
        lo = std::max(from, s - step);
    found = {lo, hi, std::clamp(s, lo, hi)};
    return true;
}

}  // namespace quadrel::oracle
