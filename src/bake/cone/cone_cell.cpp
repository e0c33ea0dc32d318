// Cone maps over dual cells, exact for the bilinear field. For each stored cell Q (cell_grid) the
// greatest height M of its corners and the ratio
//     c = min over cells R with M_R > M_Q of  distance(Q, R) / (M_R - M_Q),
// where distance is that of the two closed rectangles in tile units, 0 for cells that touch. A ray
// z above M_Q that leaves Q moves at most c (z' - M_Q) sideways before it is down at z', and no
// cell that it can meet by then is higher than z'. To be fetched by cell, never interpolated.
//
// The minimum is found by descending the maximum pyramid, nearest nodes first; a node's own
// distance and height bound all that is in it, rounding included, because every operation is
// monotonic. A cell starts with the cell that decided for its neighbour, which mostly is near to
// the minimum already. The result is that of comparing all cells with all.
#include "bake/cone/cone.hpp"
#include "bake/generators.hpp"
#include "bake/pyramid/pyramid.hpp"

namespace quadrel {

namespace {

/// Whole cells between cell q and the nearest of cells [first, last] of an axis; 0 if they touch.
int cells_between(int q, int first, int last, const GridAxis& axis) {
    if (q >= first && q <= last) return 0;
    int least = q < first ? first - q : q - last;
    if (axis.periodic) {
        const int around = q < first ? q + axis.count - last : first + axis.count - q;
        least = std::min(least, around);
    }
    return least - 1;
}

/// A node of the pyramid.
struct Node {
    int level, x, y;
};

class CellConeSearch {
  public:
    CellConeSearch(const BakeJob& job, const Texture& pyramid)
        : cells_(cell_grid(job.plane.width, job.plane.height, job.sampler)),
          metric_(job.plane.width, job.plane.height),
          limit_(job.parameter("c_max")),
          view_(pyramid.view()) {}

    /// The ratio of cell (i, j). `decider`: any cell; becomes the one that decided.
    float operator()(int i, int j, Node& decider) const {
        const double own = greatest(0, i, j);
        if (touching(i, j, own)) return 0;
        double best = bound(i, j, own, decider);
        descend(i, j, own, {view_.levels - 1, 0, 0}, best, decider);
        return safe_ratio(best, limit_);
    }

  private:
    float greatest(int level, int x, int y) const {
        return view_.texels[view_.offset[level] + y * view_.width[level] + x];
    }

    /// Whether one of the eight cells around is higher: most cells end here.
    bool touching(int i, int j, double own) const {
        for (int k = 0; k < 9; ++k) {
            const int x = HeightPlane::wrap_step(i + k % 3 - 1, cells_.u);
            const int y = HeightPlane::wrap_step(j + k / 3 - 1, cells_.v);
            if (greatest(0, x, y) > own) return true;
        }
        return false;
    }

    /// The least ratio that anything in a node can impose.
    double bound(int i, int j, double own, const Node& node) const {
        const double rise = greatest(node.level, node.x, node.y) - own;
        if (!(rise > 0)) return limit_;
        const auto gap = [&](int q, int n, const GridAxis& axis) {
            const int first = n << node.level;
            const int last = std::min((n + 1) << node.level, axis.count) - 1;
            return cells_between(q, first, last, axis);
        };
        const double distance = metric_(gap(i, node.x, cells_.u), gap(j, node.y, cells_.v));
        return std::min(cone_ratio(distance, rise), limit_);
    }

    void descend(int i, int j, double own, const Node& node, double& best, Node& decider) const {
        if (node.level == 0) {
            // Its bound is below the best, or it would not have been visited.
            best = bound(i, j, own, node);
            decider = node;
            return;
        }
        std::pair<double, Node> children[4];
        int count = 0;
        for (int k = 0; k < 4; ++k) {
            const Node child{node.level - 1, 2 * node.x + k % 2, 2 * node.y + k / 2};
            if (child.x >= view_.width[child.level] || child.y >= view_.height[child.level])
                continue;
            const double least = bound(i, j, own, child);
            int at = count++;
            for (; at > 0 && children[at - 1].first > least; --at) children[at] = children[at - 1];
            children[at] = {least, child};
        }
        for (int k = 0; k < count && children[k].first < best; ++k)
            descend(i, j, own, children[k].second, best, decider);
    }

    Grid cells_;
    TileMetric metric_;
    double limit_;
    TextureView view_;
};

}  // namespace

std::shared_ptr<Texture> bake_cone_cell(const BakeJob& job) {
    const auto pyramid = cell_max_pyramid(job, 0.05);
    const LevelSize size(pyramid->view().width[0], pyramid->view().height[0]);
    const auto map = job.make(2, 1, {size});
    const CellConeSearch search(job, *pyramid);
    const float* const greatest = pyramid->level_texels(0, 0);
    float* const texels = map->level_texels(0, 0);
    job.rows(size.second, 0.95, [&](int j) {
        Node decider{0, 0, 0};
        for (int i = 0; i < size.first; ++i) {
            const std::size_t cell = static_cast<std::size_t>(j) * size.first + i;
            texels[2 * cell] = greatest[cell];
            texels[2 * cell + 1] = search(i, j, decider);
        }
    });
    return map;
}

}  // namespace quadrel
