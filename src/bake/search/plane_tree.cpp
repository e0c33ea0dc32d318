#include "bake/search/plane_tree.hpp"

namespace quadrel {

namespace {

/// Of the level that is one node.
int top_level(const Grid& grid) {
    int level = 0;
    while ((std::max(grid.u.count, grid.v.count) - 1) >> level > 0) ++level;
    return level;
}

}  // namespace

PlaneTree::PlaneTree(const BakeJob& job, double share, int channels, int reach, const Value& value)
    : channels_(channels),
      top_level_(top_level(job.plane.grid)),
      root_level_(top_level_),
      u_(job.plane.grid.u, top_level_),
      v_(job.plane.grid.v, top_level_) {
    const Grid& grid = job.plane.grid;
    while (u_.size(root_level_) < grid.u.count + reach ||
           v_.size(root_level_) < grid.v.count + reach)
        ++root_level_;
    for (int level = 0; level <= top_level_; ++level) {
        const std::size_t rows = v_.nodes(level) + 2;
        levels_.emplace_back(rows * (u_.nodes(level) + 2) * channels);
        job.rows(static_cast<int>(rows), share / (top_level_ + 1), [&](int row) {
            const int v = row - 1;
            if (level > 0) return reduce_row(level, v);
            for (int u = -1; u <= grid.u.count; ++u) {
                const int x = std::clamp(u, 0, grid.u.count - 1);
                const int y = std::clamp(v, 0, grid.v.count - 1);
                for (int c = 0; c < channels; ++c) levels_[0][place(0, u, v) + c] = value(x, y, c);
            }
        });
    }
}

void PlaneTree::reduce_row(int level, int node_v) {
    const std::vector<float>& finer = levels_[level - 1];
    const auto child = [&](int node, int k, const TreeAxis& axis) {
        return std::clamp(2 * node + k, -1, axis.nodes(level - 1));
    };
    for (int node_u = -1; node_u <= u_.nodes(level); ++node_u) {
        for (int c = 0; c < channels_; ++c) {
            const auto value = [&](int k) {
                const int x = child(node_u, k % 2, u_), y = child(node_v, k / 2, v_);
                return finer[place(level - 1, x, y) + c];
            };
            levels_[level][place(level, node_u, node_v) + c] =
                std::max({value(0), value(1), value(2), value(3)});
        }
    }
}

}  // namespace quadrel
