#include "bake/cone/relaxed_falls.hpp"

#include "bake/rounding.hpp"
#include "bake/search/block_search.hpp"
#include "bake/search/octants.hpp"

namespace quadrel {

namespace {

/// The texels behind one. Bounds are squares of distance over depth, of the nearest points of
/// squares that are a little larger than texels, for what samples are off by.
class FallSearch {
  public:
    FallSearch(const HeightPlane& plane, const RayErrors& errors, float depth)
        : plane_(plane), half_(0.55 + 2 * errors.samples), own_(depth - errors.depth) {
        best_.fill(widest_);
    }

    bool look(Candidate& candidate, const float* greatest) const {
        return !touches(candidate.at) && bound(candidate, *greatest);
    }
    bool matters(const Candidate& candidate) const {
        bool any = false;
        for (int k = 0; k < 8; ++k)
            any |= (candidate.sectors >> k & 1u) != 0 && candidate.bound < best_[k];
        return any;
    }
    /// Far away a block's bound is nearly that of its texels. (A block of several images is not.)
    bool is_fine(const Candidate& candidate) const {
        const Offsets& at = candidate.at;
        const int size = std::max(at.u_high - at.u_low, at.v_high - at.v_low) + 1;
        return size <= std::max(at.gap_u(), at.gap_v()) / 4;
    }
    void take(const Candidate& candidate) {
        for (int k = 0; k < 8; ++k)
            if (candidate.sectors >> k & 1u) best_[k] = std::min(best_[k], candidate.bound);
        widest_ = *std::max_element(best_.begin(), best_.end());
    }

    /// The texels that `look` leaves out.
    void add_touching(const PlaneTree& depths, int x, int y) {
        for (int k = 0; k < 9; ++k) {
            const int di = k % 3 - 1, dj = k / 3 - 1;
            Candidate candidate;
            candidate.at = {di, di, dj, dj};
            if (k != 4 && bound(candidate, *depths.greatest(depths.texel(x + di, y + dj))))
                take(candidate);
        }
    }

    RelaxedFalls::Octants falls() const {
        RelaxedFalls::Octants all;
        for (int k = 0; k < 8; ++k) all[k] = round_down(std::sqrt(best_[k]) * (1 - safe_slack));
        return all;
    }

  private:
    static bool touches(const Offsets& at) {
        return at.u_low >= -1 && at.u_high <= 1 && at.v_low >= -1 && at.v_high <= 1;
    }
    bool bound(Candidate& candidate, double depth) const {
        const Offsets& at = candidate.at;
        const double fall = depth - own_;
        if (!(fall > 0)) return false;
        const double u = std::max(at.gap_u() - half_, 0.0) / plane_.width;
        const double v = std::max(at.gap_v() - half_, 0.0) / plane_.height;
        candidate.bound = (u * u + v * v) / (fall * fall);
        if (candidate.bound >= widest_) return false;
        candidate.sectors =
            octants_of({(at.u_low - half_) * plane_.height, (at.u_high + half_) * plane_.height},
                       {(at.v_low - half_) * plane_.width, (at.v_high + half_) * plane_.width});
        return matters(candidate);
    }

    const HeightPlane& plane_;
    double half_, own_;
    double widest_ = RelaxedFalls::gentlest * RelaxedFalls::gentlest;
    std::array<double, 8> best_;
};

}  // namespace

RelaxedFalls::RelaxedFalls(const BakeJob& job, double share, const RelaxedRays& rays,
                           const RayErrors& errors)
    : columns_(job.plane.grid.u.count),
      all_(job.plane.heights.size()),
      far_(job.plane.heights.size()) {
    // A texel and what is behind it are both inside of a cone: at most two tiles apart.
    const int reach = 2 * std::max(job.plane.width, job.plane.height) + 2;
    const PlaneTree depths(job, share * 0.05, 1, reach,
                           [&](int x, int y, int) { return rays.depth(x, y); });
    job.rows(job.plane.grid.v.count, share * 0.95, [&](int y) {
        job.progress.check_time();
        for (int x = 0; x < columns_; ++x) {
            FallSearch search(job.plane, errors, rays.depth(x, y));
            BlockSearch(depths, x, y, search).try_all();
            far_[at(x, y)] = search.falls();
            search.add_touching(depths, x, y);
            all_[at(x, y)] = search.falls();
        }
    });
}

}  // namespace quadrel
