// Relaxed cone maps: the widest cones in which a ray from above pierces the field at most once.
//
// relaxed-cone. Source: Policarpo, Oliveira, "Relaxed Cone Stepping for Relief Mapping", GPU Gems
// 3, chapter 18, the preprocess of listing 18-1: for every texel q a ray from above the apex p
// through q goes on below q in 128 point samples until it is outside again. In float32, as the
// listing. Differs where q is as high as can be (depth 0): the listing divides by 0 there, here q
// itself counts; and in leaving out rays that cannot narrow the cone further, which changes
// nothing:
//
// A ray that comes out has passed from a texel into a deeper one, outwards, and on its way there is
// an edge between two neighbours that falls: of a texel a that is no deeper than the ray is where
// it is found outside, and no further away. So the ratio is at least that of a's nearest point. The
// falls that are inside of the cone so far bound which rays can matter: those that are above the
// cone's wall where the nearest of them, in their octant, begins. Their depth over distance,
// which is what a ray keeps, is that at most.
#include <array>
#include <limits>

#include "bake/cone.hpp"
#include "bake/generators.hpp"
#include "bake/octants.hpp"
#include "bake/relaxed_rays.hpp"

namespace quadrel {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Ratios of float32 are that much off the true ones, at most, relatively.
constexpr double wider = 1.0001;

/// The channels of the tree: heights above depth 1's level, negative: -depth. First of all texels,
/// then of those behind which the field falls towards -u or -v, +u or -v, -u or +v, +u or +v.
constexpr int channels = 5;
constexpr float no_texel = -2;

float tree_value(const HeightPlane& plane, const RelaxedRays& rays, int x, int y, int c) {
    const float depth = rays.depth(x, y);
    if (c == 0) return -depth;
    const int x1 = HeightPlane::wrap_step(x + ((c - 1) % 2 ? 1 : -1), plane.grid.u);
    const int y1 = HeightPlane::wrap_step(y + ((c - 1) / 2 ? 1 : -1), plane.grid.v);
    // Depth 0 counts by itself.
    const bool falls = rays.depth(x1, y) > depth || rays.depth(x, y1) > depth || depth == 0;
    return falls ? -depth : no_texel;
}

/// What all searches share. Lengths in texels are what float32 may be off by.
struct RelaxedField {
    RelaxedField(const BakeJob& job)
        : plane(job.plane),
          metric(plane.width, plane.height),
          rays(plane, job.whole("steps")),
          tree(job, 0.01, channels, std::max(plane.width, plane.height) + 2,
               [&](int x, int y, int c) { return tree_value(plane, rays, x, y, c); }) {
        // Inside of a cone all is within 4 tiles of texel 0, where a rounding is up to 2^-23.
        const double side = std::max(plane.width, plane.height);
        start_error = side * 0x1p-21;
        depth_error = job.whole("steps") * 0x1p-24;
        ray_error = side * (job.whole("steps") + 8) * 0x1p-22;
    }

    const HeightPlane& plane;
    TileMetric metric;
    RelaxedRays rays;
    PlaneTree tree;
    double start_error, ray_error, depth_error;
};

/// A cone as far as it is known.
struct RelaxedCone {
    const RelaxedField& field;
    Apex apex;
    double depth;    ///< of the apex
    float best = 1;  ///< ratio
    Decider decider{};
    std::array<double, 8> fall{};  ///< distance of the nearest fall of each octant, or infinite

    /// At least the distance of any point of a block whose texels reach `half` from their centres.
    double distance(const Offsets& at, double half) const {
        return field.metric(std::max(at.gap_u() - half, 0.0), std::max(at.gap_v() - half, 0.0));
    }
};

/// Finds the falls inside of a cone that are nearest.
struct FallSearch {
    RelaxedCone& cone;
    double half = 0.55 + 2 * cone.field.ray_error;

    bool look(Candidate& candidate, const float* greatest) const {
        const Offsets& at = candidate.at;
        float least_depth = no_texel;
        for (int k = 0; k < 4; ++k) {
            const bool along_u = k % 2 ? at.u_high >= 0 : at.u_low <= 0;
            const bool along_v = k / 2 ? at.v_high >= 0 : at.v_low <= 0;
            if (along_u && along_v) least_depth = std::max(least_depth, greatest[k + 1]);
        }
        const double rise = cone.depth + least_depth;
        if (!(rise > 0)) return false;
        candidate.bound = cone.distance(at, half);
        if (candidate.bound > rise * cone.best * wider) return false;
        candidate.sectors = octants_of(at, half, cone.field.plane.width, cone.field.plane.height);
        return matters(candidate);
    }
    bool matters(const Candidate& candidate) const {
        bool any = false;
        for (int k = 0; k < 8; ++k)
            any |= (candidate.sectors >> k & 1u) != 0 && candidate.bound < cone.fall[k];
        return any;
    }
    void take(const Candidate& candidate) {
        for (int k = 0; k < 8; ++k)
            if (candidate.sectors >> k & 1u) cone.fall[k] = std::min(cone.fall[k], candidate.bound);
    }
};

/// Follows the rays that can narrow a cone.
struct RaySearch {
    RelaxedCone& cone;

    bool look(Candidate& candidate, const float* greatest) const {
        const Offsets& at = candidate.at;
        const double rise = cone.depth + greatest[0];
        if (!(rise > 0)) return false;
        candidate.bound = cone.distance(at, cone.field.start_error) / rise;
        return matters(candidate) && comes_out(at, -greatest[0]);
    }
    bool matters(const Candidate& candidate) const { return candidate.bound <= cone.best * wider; }
    void take(const Candidate& candidate) {
        const Offsets& at = candidate.at;
        const float ratio =
            cone.field.rays.ratio(cone.apex.i, cone.apex.j, at.u_low, at.v_low, cone.best);
        if (!(ratio < cone.best)) return;
        cone.best = ratio;
        cone.decider = {candidate.block.u.low, candidate.block.v.low, true};
    }

  private:
    /// Whether a ray of the block can come out inside of the cone. `depth`: the least.
    bool comes_out(const Offsets& at, double depth) const {
        const RelaxedField& field = cone.field;
        const double furthest = field.metric(std::max(-at.u_low, at.u_high) + field.start_error,
                                             std::max(-at.v_low, at.v_high) + field.start_error);
        const double least = depth / furthest + 1 / (cone.best * wider);
        const unsigned octants = octants_of(at, 0.5, field.plane.width, field.plane.height);
        for (int k = 0; k < 8; ++k) {
            if ((octants >> k & 1u) != 0 && cone.fall[k] * least <= cone.depth + field.depth_error)
                return true;
        }
        return false;
    }
};

class RelaxedSearch {
  public:
    explicit RelaxedSearch(const RelaxedField& field) : field_(&field) {}

    float operator()(const Apex& apex) {
        RelaxedCone cone{*field_, apex, field_->rays.depth(apex.i, apex.j)};
        RaySearch rays{cone};
        BlockSearch ray_search(field_->tree, apex.i, apex.j, rays);
        cone.fall.fill(0);
        if (decider_.known) ray_search.try_texel(decider_.x, decider_.y);
        cone.fall.fill(infinite);
        FallSearch falls{cone};
        BlockSearch(field_->tree, apex.i, apex.j, falls).try_all();
        ray_search.try_all();
        decider_ = cone.decider;
        return cone.best;
    }

  private:
    const RelaxedField* field_;
    Decider decider_{};
};

}  // namespace

std::shared_ptr<Texture> bake_relaxed_cone(const BakeJob& job) {
    const RelaxedField field(job);
    return make_cone_map(job, 0.99, RelaxedSearch(field));
}

}  // namespace quadrel
