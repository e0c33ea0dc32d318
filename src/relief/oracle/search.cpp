#include "relief/oracle/search.hpp"

namespace quadrel::oracle {
namespace {

/// In one piece.
Judged judge_piece(const GridRay& grid_ray, const Segment& segment, bool start) {
    const Piece<Interval>& piece = segment.pieces[0];
    const PieceRay ray(grid_ray, piece);
    const double from = segment.from, to = segment.to;
    if (ray.upper_bound(from, to) < 0) return {Verdict::clear};
    const Interval first = ray.above(from);
    if (first.lo >= 0 && start) return {Verdict::met, {from, from, from}, &piece};
    Judged judged{Verdict::met, {}, &piece};
    const bool reaches_floor = grid_ray.z.climb < 0 && to >= grid_ray.end;
    const bool found = first.hi < 0 && ray.bracket(from, to, reaches_floor, judged.bracket);
    return found ? judged : Judged{Verdict::open};
}

/// Rationals take some 50 microseconds a segment. A ray needs them for one or two, unless it runs
/// along a border closer than double can tell.
constexpr int most_exact_segments = 4096;

/// In several: all must be below, or all but the one that the ray ends in, and that one met there.
Judged judge_border(const GridRay& grid_ray, const Segment& segment, bool start, double widest) {
    int not_below = 0, which = -1;
    for (int k = 0; k < segment.count; ++k) {
        const PieceRay ray(grid_ray, segment.pieces[static_cast<std::size_t>(k)]);
        if (ray.upper_bound(segment.from, segment.to) < 0) continue;
        ++not_below;
        which = k;
    }
    if (not_below == 0) return {Verdict::clear};
    const double length = segment.to - segment.from;
    if (not_below > 1 || which != segment.last || start || length > widest) return {Verdict::open};
    const Piece<Interval>& piece = segment.pieces[static_cast<std::size_t>(which)];
    if (!(PieceRay(grid_ray, piece).above(segment.to).lo >= 0)) return {Verdict::open};
    const double middle = segment.from + length / 2;
    return {Verdict::met, {segment.from, segment.to, middle}, &piece};
}

}  // namespace

Judged judge(const GridRay& ray, const Segment& segment, bool start, double widest) {
    if (!segment.complete) return {Verdict::open};
    return segment.count == 1 ? judge_piece(ray, segment, start)
                              : judge_border(ray, segment, start, widest);
}

namespace {

/// One search for the first hit.
class Search {
  public:
    Search(const Field& field, const Ray& ray, bool exactly)
        : field_(field),
          ray_(ray),
          heights_(field),
          grid_ray_(view_ray(heights_, ray)),
          exactly_(exactly) {}

    Hit run() {
        Hit hit;
        if (!grid_ray_.is_finite() || grid_ray_.is_too_long()) return refused();
        CellWalk walk(heights_, grid_ray_);
        const WalkEnd end = walk.run([&](const Part& part) { return visit(part, hit); });
        hit.steps = walk.steps;
        if (end == WalkEnd::too_long) hit = ended(hit, Status::cap, Uncertified::too_long);
        if (end == WalkEnd::passed) conclude(hit, Status::floor);
        place(hit.s, hit);
        return hit;
    }

  private:
    Hit refused() const {
        const bool finite = grid_ray_.is_finite();
        Hit hit = ended({}, finite ? Status::cap : Status::nan,
                        finite ? Uncertified::too_long : Uncertified::not_finite);
        place(hit.s, hit);
        return hit;
    }
    /// Without a hit: at the top where the search was given up, else at the bottom.
    static Hit ended(Hit hit, Status status, Uncertified reason) {
        hit.status = status;
        hit.s = status == Status::cap ? 0 : 1;
        hit.reason = reason;
        return hit;
    }
    void conclude(Hit& hit, Status status) const {
        hit.status = status;
        hit.reason = reason_;
        hit.certificate = reason_ != Uncertified::proven ? Certificate::none
                          : exact_segments_ > 0          ? Certificate::exact
                                                         : Certificate::bounds;
    }

    bool visit(const Part& part, Hit& hit) {
        CellSegments segments(field_.surface, heights_, grid_ray_, part);
        if (!segments.finite()) {
            hit = ended({}, Status::nan, Uncertified::not_a_number);
            return true;
        }
        return segments.each([&](const Segment& segment) { return visit(segment, hit); });
    }

    bool visit(const Segment& segment, Hit& hit) {
        const bool start = segment.from == 0;
        Judged judged{Verdict::open};
        if (!exactly_) judged = judge(grid_ray_, segment, start);
        if (judged.verdict == Verdict::clear) return false;
        if (judged.verdict == Verdict::met) {
            meet(judged.bracket, *judged.piece, hit);
            return true;
        }
        if (++exact_segments_ > most_exact_segments && !exactly_) {
            hit = ended({}, Status::cap, Uncertified::too_long);
            return true;
        }
        const ExactResult exact = search_exactly(field_, ray_, segment.from, segment.to);
        if (exact.end == ExactEnd::met) meet(exact.bracket, exact.piece, hit);
        if (exact.end != ExactEnd::unavailable) return exact.end == ExactEnd::met;
        reason_ = Uncertified::not_exact;
        return meet_unproven(segment, hit);
    }

    /// As double has it, where nothing better can be had.
    bool meet_unproven(const Segment& segment, Hit& hit) {
        for (int k = 0; k < segment.count; ++k) {
            const Piece<Interval>& piece = segment.pieces[static_cast<std::size_t>(k)];
            const PieceRay ray(grid_ray_, piece);
            const double s = ray.above(segment.from).middle() >= 0
                                 ? segment.from
                                 : ray.guess(segment.from, segment.to);
            if (!(ray.above(s).hi >= 0)) continue;
            meet({segment.from, segment.to, s}, piece, hit);
            return true;
        }
        return false;
    }

    void meet(const Bracket& bracket, const Piece<Interval>& piece, Hit& hit) const {
        const PieceRay along(grid_ray_, piece);
        const double s = bracket.s;
        hit.s = s;
        hit.bound = std::max((Interval(s) - bracket.lo).hi, (Interval(bracket.hi) - s).hi);
        const double f = along.f(s).middle(), g = along.g(s).middle();
        hit.height = piece.height(f, g).middle();
        hit.gradient_u = (piece.b + piece.d * Interval(g)).middle() * heights_.width();
        hit.gradient_v = (piece.c + piece.d * Interval(f)).middle() * heights_.height();
        const bool wall = field_.surface == Surface::block && hit.height > 1 - bracket.lo;
        hit.condition = s == 0 || wall ? 0 : std::fabs(1 / along.slope(s).middle());
        const double half = field_.surface == Surface::block ? 0.5 : 0;
        const auto within = [half](double x, Index origin, Index cell) {
            return std::clamp(x + half - static_cast<double>(cell - origin), 0.0, 1.0);
        };
        hit.place_x = within(f, piece.i, piece.cell_i);
        hit.place_y = within(g, piece.j, piece.cell_j);
        hit.cell_x = reduced_cell(piece.cell_i, heights_.grid().u);
        hit.cell_y = reduced_cell(piece.cell_j, heights_.grid().v);
        conclude(hit, Status::hit);
    }

    void place(double s, Hit& hit) const {
        hit.u = ray_.u + (s - ray_.s_polygon) * ray_.Ku;
        hit.v = ray_.v + (s - ray_.s_polygon) * ray_.Kv;
    }

    const Field& field_;
    const Ray& ray_;
    Heights heights_;
    GridRay grid_ray_;
    bool exactly_;
    int exact_segments_ = 0;
    Uncertified reason_ = Uncertified::proven;
};

}  // namespace

template <class T>
T bound_of(const Hit& hit) {
    const double rounding = std::fabs(static_cast<double>(static_cast<T>(hit.s)) - hit.s);
    const double bound = (Interval(hit.bound) + Interval(rounding)).hi;
    const T rounded = static_cast<T>(bound);
    return rounded >= bound ? rounded : std::nextafter(rounded, std::numeric_limits<T>::infinity());
}
template float bound_of<float>(const Hit& hit);
template double bound_of<double>(const Hit& hit);

Hit first_hit(const Field& field, const Ray& ray, bool exactly) {
    return Search(field, ray, exactly).run();
}

}  // namespace quadrel::oracle
