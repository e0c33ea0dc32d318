// Cone maps from a maximum pyramid. Source: Valasek, Ban, "Quick Cone Map Generation on the GPU",
// Eurographics 2022 (short papers): on each level the eight neighbours of the node that holds the
// apex bound the cone, as if their greatest height stood on their near side.
// Differs in taking, with near_side 0, the nearest texel centre of the neighbour in place of its
// near side, which is what the brute-force map measures; either is never wider than that map. Sizes
// need not be powers of two.
#include "bake/cone/cone.hpp"
#include "bake/generators.hpp"
#include "bake/pyramid/pyramid.hpp"

namespace quadrel {

namespace {

/// One axis of a level as the apex sees it: nodes of 2^level texels.
struct NodeAxis {
    NodeAxis(const GridAxis& axis, int level, int nodes) : grid(axis), shift(level), count(nodes) {}

    /// The node `step` (-1, 0 or 1) away from the one that holds texel i; -1 if there is none.
    int neighbour(int i, int step) const {
        const int node = (i >> shift) + step;
        if (count == 1 && step != 0) return -1;
        if (node >= 0 && node < count) return node;
        return grid.periodic ? (node < 0 ? count - 1 : 0) : -1;
    }
    /// Texels between i and the nearest texel of a node in the direction of `step`.
    int gap(int i, int node, int step) const {
        if (step == 0) return 0;
        const int first = node << shift, last = std::min((node + 1) << shift, grid.count) - 1;
        const int ahead = first - i, behind = i - last;
        if (step > 0) return ahead > 0 ? ahead : ahead + grid.count;
        return behind > 0 ? behind : behind + grid.count;
    }

    GridAxis grid;
    int shift, count;
};

struct QuickLevel {
    NodeAxis u, v;
    const float* greatest;
};

class QuickSearch {
  public:
    QuickSearch(const BakeJob& job, const Texture& pyramid)
        : metric_(job.plane.width, job.plane.height),
          inset_(job.parameter("near_side") / 2),
          limit_(job.parameter("c_max")) {
        const TextureView& view = pyramid.view();
        for (int level = 0; level < view.levels; ++level) {
            levels_.push_back({NodeAxis(job.plane.grid.u, level, view.width[level]),
                               NodeAxis(job.plane.grid.v, level, view.height[level]),
                               pyramid.level_texels(level, 0)});
        }
    }

    float operator()(const Apex& apex) const {
        double best = limit_;
        for (const QuickLevel& level : levels_) {
            for (int k = 0; k < 9; ++k) {
                if (k != 4) best = std::min(best, ratio(level, apex, k % 3 - 1, k / 3 - 1));
            }
        }
        return safe_ratio(best, limit_);
    }

  private:
    double ratio(const QuickLevel& level, const Apex& apex, int step_u, int step_v) const {
        const int x = level.u.neighbour(apex.i, step_u), y = level.v.neighbour(apex.j, step_v);
        if (x < 0 || y < 0) return limit_;
        const double rise =
            level.greatest[static_cast<std::size_t>(y) * level.u.count + x] - apex.height;
        if (rise <= 0) return limit_;
        const double du = inset(level.u.gap(apex.i, x, step_u));
        const double dv = inset(level.v.gap(apex.j, y, step_v));
        return cone_ratio(metric_(du, dv), rise);
    }
    double inset(int gap) const { return gap == 0 ? 0 : gap - inset_; }

    TileMetric metric_;
    double inset_, limit_;
    std::vector<QuickLevel> levels_;
};

}  // namespace

std::shared_ptr<Texture> bake_cone_quick(const BakeJob& job) {
    const auto pyramid = texel_max_pyramid(job, 0.05);
    const QuickSearch search(job, *pyramid);
    return make_cone_map(job, 0.95, search);
}

}  // namespace quadrel
