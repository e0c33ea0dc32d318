// The walk of search.cpp over all rays of a range at once: positions are intervals there already,
// and what is shown of an interval holds for each ray of it.
#include "quadrel/relief/trace/oracle/common_hit.hpp"

#include "relief/oracle/search.hpp"

namespace quadrel::oracle {
namespace {

/// Cells: rays that are further apart are not followed together.
constexpr double most_apart = 0.5;

class CommonSearch {
  public:
    CommonSearch(const Field& field, const RayRange& rays)
        : field_(field), heights_(field), ray_(range_ray(heights_, rays)) {}

    CommonHit run() {
        if (!ray_.is_finite()) return unproven(Uncertified::not_finite);
        if (ray_.is_too_long()) return unproven(Uncertified::too_long);
        if (!are_close(ray_.x) || !are_close(ray_.y)) return unproven(pixel_open);
        CommonHit hit;
        CellWalk walk(heights_, ray_);
        const WalkEnd end = walk.run([&](const Part& part) { return visit(part, hit); });
        if (end == WalkEnd::too_long) return unproven(Uncertified::too_long);
        if (end == WalkEnd::passed) hit.status = Status::floor;
        return hit;
    }

  private:
    static CommonHit unproven(Uncertified reason) {
        CommonHit hit;
        hit.reason = reason;
        return hit;
    }

    /// Whether the walk's bounds hold along an axis: the rays go one way, or stay in one cell.
    static bool are_close(const RayAxis& axis) {
        const Interval &start = axis.position.start, &rate = axis.position.rate;
        if (!(start.width() + rate.width() <= most_apart)) return false;
        if (axis.position.moves()) return rate.width() <= std::fabs(rate.middle());
        const Interval all = start + hull(Interval(0), rate);
        return axis.cell(all.lo) == axis.cell(all.hi);
    }

    bool visit(const Part& part, CommonHit& hit) {
        CellSegments segments(field_.surface, heights_, ray_, part);
        if (!segments.finite()) {
            hit = unproven(Uncertified::not_a_number);
            return true;
        }
        return segments.each([&](const Segment& segment) {
            const Judged judged = judge(ray_, segment, segment.from == 0, most_apart);
            if (judged.verdict == Verdict::clear) return false;
            hit = judged.verdict == Verdict::met ? met(judged) : unproven(pixel_open);
            return true;
        });
    }

    CommonHit met(const Judged& judged) const {
        CommonHit hit;
        hit.status = Status::hit;
        hit.lo = judged.bracket.lo;
        hit.hi = judged.bracket.hi;
        hit.cell_x = reduced_cell(judged.piece->cell_i, heights_.grid().u);
        hit.cell_y = reduced_cell(judged.piece->cell_j, heights_.grid().v);
        return hit;
    }

    const Field& field_;
    Heights heights_;
    GridRay ray_;
};

}  // namespace

CommonHit common_hit(const Field& field, const RayRange& rays) {
    return CommonSearch(field, rays).run();
}

}  // namespace quadrel::oracle
