#include "relief/oracle/exact.hpp"

#ifdef QUADREL_HAS_GMP
#include <gmpxx.h>
#endif

namespace quadrel::oracle {

#ifdef QUADREL_HAS_GMP
namespace {

using Rational = mpq_class;

Index floor_of(const Rational& x) {
    mpz_class quotient;
    mpz_fdiv_q(quotient.get_mpz_t(), x.get_num_mpz_t(), x.get_den_mpz_t());
    return quotient.get_si();
}

/// The greatest double that is not above x >= 0.
double floor_double(const Rational& x) { return x.get_d(); }  // towards 0
double ceil_double(const Rational& x) {
    const double d = x.get_d();
    return Rational(d) == x ? d : up(d);
}

/// p(s) = start + rate s.
struct ExactLine {
    Rational start, rate;

    Rational at(const Rational& s) const { return start + rate * s; }
    /// The first s after `s` at which it is 0, if that is before `end`; else `end`.
    Rational next_root(const Rational& s, const Rational& end) const {
        if (rate == 0) return end;
        const Rational root = -start / rate;
        return root > s && root < end ? root : end;
    }
};

struct ExactAxis {
    ExactLine position;
    GridAxis grid;

    ExactAxis(double u, double K, double s_polygon, int texels, Wrap wrap, const GridAxis& axis)
        : grid(axis) {
        const Rational at_top =
            Rational(u) - Rational(whole_periods(u, wrap)) - Rational(s_polygon) * Rational(K);
        position = {at_top * texels - Rational(1, 2), Rational(K) * texels};
    }
    Index cell(const Rational& s) const {
        const Rational x = position.at(s);
        if (grid.periodic) return floor_of(x);
        const Index last = grid.first + grid.count - 1;
        if (x < grid.first) return grid.first;
        return x >= Rational(last) ? last : floor_of(x);
    }
    /// The first s after `s` at which a border is met, if that is before `end`; else `end`. An axis
    /// that does not repeat has none beyond its outermost cells.
    Rational next_border(const Rational& s, const Rational& end) const {
        if (position.rate == 0) return end;
        const bool forward = position.rate > 0;
        Rational x = position.at(s);
        const Index low = grid.first, high = grid.first + grid.count;
        if (!grid.periodic) {
            if (forward ? x >= high - 1 : x <= low + 1) return end;
            if (forward && x < low) x = low;
            if (!forward && x > high) x = high;
        }
        const Index below = floor_of(x);
        const Index border = forward ? below + 1 : x == below ? below - 1 : below;
        return ExactLine{position.start - border, position.rate}.next_root(s, end);
    }
};

/// F along a piece, tau = s - from.
struct ExactQuadratic {
    Rational A, B, C;

    Rational at(const Rational& tau) const { return (A * tau + B) * tau + C; }
};

class ExactSearch {
  public:
    ExactSearch(const Field& field, const Ray& ray)
        : surface_(field.surface),
          heights_(field),
          x_(ray.u, ray.Ku, ray.s_polygon, heights_.width(), heights_.sampler().wrap_u,
             heights_.grid().u),
          y_(ray.v, ray.Kv, ray.s_polygon, heights_.height(), heights_.sampler().wrap_v,
             heights_.grid().v) {}

    ExactResult run(const Rational& from, const Rational& to) {
        for (Rational s = from;;) {
            // A point may lie in another block than the ray before and after it.
            if ((s == 0 || surface_ == Surface::block) && meets_at(s)) return result_;
            if (s >= to) return {ExactEnd::clear, {}, {}};
            const Rational end = x_.next_border(s, y_.next_border(s, to));
            const Rational in_cell = (s + end) / 2;
            const Index i = x_.cell(in_cell), j = y_.cell(in_cell);
            const Rational next = next_line(i, j, s, end), in_piece = (s + next) / 2;
            if (meets(i, j, sides(i, j, in_piece), s, next)) return result_;
            s = next;
        }
    }

  private:
    ExactLine line_of(Index i, Index j, int k) const {
        const bool main = has_main_edge(surface_, heights_.corners(i, j));
        const auto at = [&](const Rational& s) {
            const Rational f = x_.position.at(s) - i, g = y_.position.at(s) - j;
            return line<Rational>(surface_, main, k, f, g);
        };
        const Rational start = at(0);
        return {start, at(1) - start};
    }
    Sides sides(Index i, Index j, const Rational& s) const {
        Sides of = 0;
        for (int k = 0; k < line_count(surface_); ++k)
            if (line_of(i, j, k).at(s) >= 0) of |= 1u << k;
        return of;
    }
    Rational next_line(Index i, Index j, const Rational& s, Rational end) const {
        for (int k = 0; k < line_count(surface_); ++k) end = line_of(i, j, k).next_root(s, end);
        return end;
    }

    /// About tau = 0 at s.
    ExactQuadratic quadratic(Index i, Index j, Sides sides, const Rational& s) const {
        const Piece<Rational> p = piece_of<Rational>(surface_, heights_.corners(i, j), i, j, sides);
        const Rational f = x_.position.at(s) - p.i, g = y_.position.at(s) - p.j;
        const Rational &dx = x_.position.rate, &dy = y_.position.rate;
        return {p.d * dx * dy, p.b * dx + p.c * dy + p.d * (f * dy + g * dx) + 1,
                p.height(f, g) - (1 - s)};
    }

    bool meets_at(const Rational& s) {
        const Index i = x_.cell(s), j = y_.cell(s);
        const Sides of = sides(i, j, s);
        if (quadratic(i, j, of, s).C < 0) return false;
        return found(i, j, of, {floor_double(s), ceil_double(s), floor_double(s)});
    }

    /// In [s, to], in one piece.
    bool meets(Index i, Index j, Sides of, const Rational& s, const Rational& to) {
        const ExactQuadratic q = quadratic(i, j, of, s);
        if (q.C >= 0) return found(i, j, of, {floor_double(s), ceil_double(s), floor_double(s)});
        Rational length = to - s;
        if (q.at(length) < 0) {
            // Only a peak between them can reach.
            if (q.A >= 0 || q.B <= 0 || q.B >= -2 * q.A * length) return false;
            length = -q.B / (2 * q.A);
            if (q.at(length) < 0) return false;
        }
        return found(i, j, of, bracket(q, s, length));
    }

    /// q is below 0 at tau = 0, not at tau = length, and crosses once between them.
    static Bracket bracket(const ExactQuadratic& q, const Rational& s, const Rational& length) {
        const double A = q.A.get_d(), B = q.B.get_d(), C = q.C.get_d();
        const double root = std::sqrt(std::max(B * B - 4 * A * C, 0.0));
        const double tau = A > 0 && B < 0 ? (root - B) / (2 * A) : -2 * C / (B + root);
        const double first = floor_double(s), last = ceil_double(s + length);
        const double guess = tau >= 0 ? std::min(s.get_d() + tau, last) : last;
        const auto below = [&](double at) {
            const Rational along = Rational(at) - s;
            return along <= 0 || (along < length && q.at(along) < 0);
        };
        double lo = std::max(guess, first), hi = lo;
        for (double step = up(guess) - guess; !below(lo); step *= 4)
            lo = std::max(first, guess - step);
        for (double step = up(guess) - guess; below(hi); step *= 4)
            hi = std::min(last, guess + step);
        return {lo, hi, std::clamp(guess, lo, hi)};
    }

    bool found(Index i, Index j, Sides of, const Bracket& bracket) {
        result_ = {ExactEnd::met, bracket,
                   piece_of<Interval>(surface_, heights_.corners(i, j), i, j, of)};
        return true;
    }

    Surface surface_;
    Heights heights_;
    ExactAxis x_, y_;
    ExactResult result_{};
};

}  // namespace

bool has_rationals() { return true; }

ExactResult search_exactly(const Field& field, const Ray& ray, double from, double to) {
    return ExactSearch(field, ray).run(Rational(from), Rational(to));
}

#else

bool has_rationals() { return false; }

ExactResult search_exactly(const Field&, const Ray&, double, double) {
    return {ExactEnd::unavailable, {}, {}};
}

#endif

}  // namespace quadrel::oracle
