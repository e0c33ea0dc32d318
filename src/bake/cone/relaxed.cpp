// Relaxed cone maps: the widest cones in which a ray from above pierces the field at most once.
//
// relaxed-cone. Source: Policarpo, Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems
// 3, chapter 18, the preprocess of listing 18-1: for every texel q a ray from above the apex p
// through q goes on below q in 128 point samples until it is outside again. In float32, as the
// listing. Differs where q is as high as can be (depth 0): the listing divides by 0 there, here q
// itself counts; and in leaving out rays that cannot narrow the cone further, which changes
// nothing: those that enter the field outside of it, and those that go down at least as steeply as
// the field does behind q, so that they never come out.
#include "bake/cone/cone.hpp"
#include "bake/cone/relaxed_falls.hpp"
#include "bake/generators.hpp"
#include "bake/search/block_search.hpp"
#include "bake/search/octants.hpp"

namespace quadrel {

namespace {

/// What ratios of float32 are off the true ones, at most; squared.
constexpr double wider = 1.0002;

/// What the searches of all texels share.
struct RelaxedField {
    explicit RelaxedField(const BakeJob& job)
        : plane(job.plane),
          per_u(1.0 / plane.width),
          per_v(1.0 / plane.height),
          steps(job.whole("steps")),
          rays(plane, steps),
          errors(plane, steps),
          falls(job, 0.2, rays, errors),
          tree(job, 0.01, 9, std::max(plane.width, plane.height) + 2, [&](int x, int y, int c) {
              return c == 0 ? -rays.depth(x, y) : -falls.all(x, y)[c - 1];
          }) {}

    const HeightPlane& plane;
    double per_u, per_v;  ///< tiles a texel
    int steps;
    RelaxedRays rays;
    RayErrors errors;
    RelaxedFalls falls;
    PlaneTree tree;  ///< of -depth and of the eight -falls
};

/// The cone of one apex: follows the rays that can narrow it.
class RelaxedCone {
  public:
    RelaxedCone(const RelaxedField& field, const Apex& apex)
        : field_(field), apex_(apex), depth_(field.rays.depth(apex.i, apex.j)) {}

    bool look(Candidate& candidate, const float* greatest) const {
        const double rise = depth_ + greatest[0];
        if (!(rise > 0)) return false;
        candidate.bound = nearest(candidate.at) / (rise * rise);
        if (!matters(candidate)) return false;
        RelaxedFalls::Octants falls;
        for (std::size_t k = 0; k < falls.size(); ++k) falls[k] = -greatest[k + 1];
        return furthest(candidate.at) * wider >
               reach(-greatest[0], falls, octants_at(candidate.at));
    }
    bool matters(const Candidate& candidate) const { return candidate.bound <= widest_; }
    /// Texels are quicker to look at one after the other.
    bool is_fine(const Candidate& candidate) const { return candidate.block.level <= 3; }

    void take(const Candidate& candidate) {
        const Offsets& at = candidate.at;
        for (int dj = at.v_low; dj <= at.v_high; ++dj)
            for (int di = at.u_low; di <= at.u_high; ++di) try_texel(di, dj);
    }

    float best() const { return best_; }
    const Decider& decider() const { return decider_; }

  private:
    void try_texel(int di, int dj) {
        const GridAxis &u = field_.plane.grid.u, &v = field_.plane.grid.v;
        const int x = HeightPlane::wrap(apex_.i + di + u.first, u);
        const int y = HeightPlane::wrap(apex_.j + dj + v.first, v);
        const float depth = field_.rays.depth(x, y);
        const double rise = depth_ - depth;
        const Offsets at{di, di, dj, dj};
        if (!(rise > 0) || nearest(at) > rise * rise * widest_) return;
        const unsigned octants = octants_at(at);
        const double reached = furthest(at) * wider;
        if (reached <= reach(depth, field_.falls.all(x, y), octants)) return;
        const bool stays = reached <= reach(depth, field_.falls.far(x, y), octants);
        const int samples = stays ? samples_nearby(at, depth) : field_.steps;
        const float ratio = field_.rays.ratio(apex_.i, apex_.j, di, dj, best_, samples);
        if (!(ratio < best_)) return;
        best_ = ratio;
        widest_ = double(ratio) * ratio * wider;
        decider_ = {apex_.i + di, apex_.j + dj, true};
    }

    /// Squares, in tiles: at most of the distance of any texel, at least of that of all.
    double nearest(const Offsets& at) const {
        const double e = field_.errors.start;
        const double u = std::max(at.gap_u() - e, 0.0) * field_.per_u;
        const double v = std::max(at.gap_v() - e, 0.0) * field_.per_v;
        return u * u + v * v;
    }
    double furthest(const Offsets& at) const {
        const double e = field_.errors.start;
        const double u = (std::max(-at.u_low, at.u_high) + e) * field_.per_u;
        const double v = (std::max(-at.v_low, at.v_high) + e) * field_.per_v;
        return u * u + v * v;
    }

    unsigned octants_at(const Offsets& at) const {
        const double e = field_.errors.start, w = field_.plane.width, h = field_.plane.height;
        return octants_of({(at.u_low - e) * h, (at.u_high + e) * h},
                          {(at.v_low - e) * w, (at.v_high + e) * w});
    }

    /// The square of how far away a ray that enters at `depth` goes down as steeply as the field.
    static double reach(double depth, const RelaxedFalls::Octants& falls, unsigned octants) {
        float least = RelaxedFalls::gentlest;
        for (std::size_t k = 0; k < falls.size(); ++k)
            least = octants >> k & 1u ? std::min(least, falls[k]) : least;
        return depth * least * (depth * least);
    }

    /// After how many samples a ray has left the texels that touch q.
    int samples_nearby(const Offsets& at, double depth) const {
        const double texels = std::max(std::abs(at.u_low), std::abs(at.v_low));
        const double step = texels / depth * (1 - depth) / field_.steps;
        return static_cast<int>(std::min((1.6 + 2 * field_.errors.samples) / step, 1e6)) + 1;
    }

    const RelaxedField& field_;
    const Apex& apex_;
    double depth_;
    float best_ = 1;
    double widest_ = wider;  ///< the square of the best, and what it may be off by
    Decider decider_{};
};

class RelaxedSearch {
  public:
    explicit RelaxedSearch(const RelaxedField& field) : field_(&field) {}

    float operator()(const Apex& apex) {
        RelaxedCone cone(*field_, apex);
        BlockSearch search(field_->tree, apex.i, apex.j, cone);
        if (decider_.known) search.try_texel(decider_.x, decider_.y);
        search.try_all();
        decider_ = cone.decider();
        return cone.best();
    }

  private:
    const RelaxedField* field_;
    Decider decider_{};
};

}  // namespace

std::shared_ptr<Texture> bake_relaxed_cone(const BakeJob& job) {
    const RelaxedField field(job);
    return make_cone_map(job, 0.79, RelaxedSearch(field));
}

}  // namespace quadrel
