// The bounds of steep-maxmip's steps on ranges: the greatest heights of all nodes that a step may
// touch, whichever cells it begins and ends in and whichever level it reads.
#pragma once

#include "quadrel/relief/trace/march/steep_maxmip.hpp"
#include "quadrel/texture/range/sampler.hpp"

namespace quadrel {

template <>
class StepBounds<Ranges> {
  public:
    StepBounds(const SampledTexture& pyramid, const SampledTexture& height,
               const vec2<Ranges>& step)
        : pyramid_(pyramid),
          view_(pyramid.view),
          grid_(cell_grid(height.view.width[0], height.view.height[0], height.sampler)),
          columns_(height.view.width[0]),
          rows_(height.view.height[0]) {
        const Ranges cells =
            max(abs(step.x) * Ranges(double(columns_)), abs(step.y) * Ranges(double(rows_)));
        for (int lane = 0; lane < 4; ++lane) {
            Levels& levels = levels_[lane];
            levels = {0, view_.levels - 1};
            if (!cells.lane[lane].is_bounded()) continue;
            const RealInterval x = cells.lane[lane].range();
            levels = {level_of(x.lo * (1 - rounding)), level_of(x.hi * (1 + rounding))};
        }
    }

    static constexpr int fetches = 9;

    Ranges operator()(const vec2<Ranges>& from, const vec2<Ranges>& to) const {
        Ranges bound(Ranged::anything());
        for (int lane = 0; lane < 4; ++lane) {
            const RealInterval all = bound_of_lane(from, to, lane);
            bound.lane[lane] = Ranged(all);
        }
        return bound + abs(bound) * Ranges(0x1p-22);
    }

  private:
    struct Levels {
        int first, last;
    };
    struct Cells {
        double first, last;
    };
    static constexpr double rounding = 0x1p-18;  ///< of logarithms near whole numbers

    int level_of(double cells) const {
        const double level = std::ceil(log2(std::max(cells * (1 + 0x1p-20), 1.0)));
        return static_cast<int>(std::min(level, double(view_.levels - 1)));
    }
    static bool cells_of(Cells& cells, const Ranged& u, int texels) {
        const Ranged x = u * Ranged(double(texels)) - Ranged(0.5);
        if (!x.is_bounded()) return false;
        constexpr double limit = 8388608;
        cells = {std::floor(std::clamp(x.range().lo, -limit, limit)),
                 std::floor(std::clamp(x.range().hi, -limit, limit))};
        return cells.last - cells.first <= 2;
    }

    RealInterval bound_of_lane(const vec2<Ranges>& from, const vec2<Ranges>& to, int lane) const {
        const RealInterval whole = range_detail::whole_map(pyramid_).channel[0];
        Cells x0, x1, y0, y1;
        if (!cells_of(x0, from.x.lane[lane], columns_) ||
            !cells_of(x1, to.x.lane[lane], columns_) || !cells_of(y0, from.y.lane[lane], rows_) ||
            !cells_of(y1, to.y.lane[lane], rows_))
            return whole;
        RealInterval all(std::numeric_limits<double>::infinity(),
                         -std::numeric_limits<double>::infinity());
        for (int level = levels_[lane].first; level <= levels_[lane].last; ++level)
            for (double a = x0.first; a <= x0.last; ++a)
                for (double b = x1.first; b <= x1.last; ++b)
                    for (double c = y0.first; c <= y0.last; ++c)
                        for (double d = y1.first; d <= y1.last; ++d) {
                            const double bound = greatest(level, a, b, c, d);
                            if (!std::isfinite(bound)) return {-bound, bound};
                            all = hull(all, RealInterval(bound));
                        }
        return all;
    }

    struct Touched {
        int nodes[3];
    };
    static Touched touched(double from, double to, const GridAxis& axis, int level) {
        const double a = stored(from, axis), b = stored(to, axis);
        const auto node = [&](double cell) { return static_cast<int>(std::ldexp(cell, -level)); };
        const bool leaves = axis.periodic && from - a != to - b;
        return {{node(a), node(b), leaves ? node(axis.count - 1) : node(a)}};
    }
    static double stored(double cell, const GridAxis& axis) {
        const double from_first = cell - axis.first, count = axis.count;
        if (axis.periodic) return from_first - count * std::floor(from_first / count);
        return std::clamp(from_first, 0.0, count - 1);
    }

    /// Of the nodes that a step from cells (a, c) to (b, d) touches; infinite where one is no
    /// number.
    double greatest(int level, double a, double b, double c, double d) const {
        const Touched x = touched(a, b, grid_.u, level), y = touched(c, d, grid_.v, level);
        const int width = view_.width[level], height = view_.height[level];
        const float* const texels = view_.texels + view_.offset[level];
        double most = -std::numeric_limits<double>::infinity();
        for (const int row : y.nodes)
            for (const int column : x.nodes) {
                const float node = texels[std::int64_t{view_.channels} *
                                          (std::int64_t{std::min(row, height - 1)} * width +
                                           std::min(column, width - 1))];
                if (!std::isfinite(node)) return std::numeric_limits<double>::infinity();
                most = std::max(most, double(node));
            }
        return most;
    }

    const SampledTexture& pyramid_;
    const TextureView& view_;
    Grid grid_;
    int columns_, rows_;
    Levels levels_[4];
};

}  // namespace quadrel
