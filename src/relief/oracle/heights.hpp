// The heights of a field and their maxima, by cells anywhere in the plane.
#pragma once

#include <algorithm>
#include <limits>

#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel::oracle {

using Index = std::int64_t;

/// The cell of one axis that a cell anywhere stands for, counted from the first stored one.
inline Index stored_cell(Index cell, const GridAxis& axis) {
    const Index from_first = cell - axis.first, count = axis.count;
    if (axis.periodic) return (from_first % count + count) % count;
    return std::clamp<Index>(from_first, 0, count - 1);
}

/// Heights at the corners of a dual cell.
struct Corners {
    double h00, h10, h01, h11;  ///< at (i, j), (i+1, j), (i, j+1), (i+1, j+1)

    double least() const { return std::min(std::min(h00, h10), std::min(h01, h11)); }
    bool finite() const {
        constexpr double end = std::numeric_limits<double>::infinity();
        for (const double h : {h00, h10, h01, h11})
            if (!(h > -end && h < end)) return false;
        return true;
    }
};

/// A node of the pyramid of maxima, and where its cells end along an axis.
struct NodeRange {
    Index index;  ///< stored
    double low,
        high;  ///< borders in the plane; infinite at the end of an axis that does not repeat
};

class Heights {
  public:
    explicit Heights(const Field& field)
        : view_(field.heights->view),
          maxima_(field.maxima->view),
          sampler_(field.heights->sampler),
          grid_(cell_grid(view_.width[0], view_.height[0], sampler_)) {}

    const Grid& grid() const { return grid_; }
    int width() const { return view_.width[0]; }
    int height() const { return view_.height[0]; }
    const SamplerState& sampler() const { return sampler_; }
    int top() const { return maxima_.levels - 1; }

    /// Of any dual cell of the plane.
    Corners corners(Index i, Index j) const {
        const Taps x = taps(stored_cell(i, grid_.u), grid_.u, width(), sampler_.wrap_u);
        const Taps y = taps(stored_cell(j, grid_.v), grid_.v, height(), sampler_.wrap_v);
        return {texel(x.first, y.first), texel(x.second, y.first), texel(x.first, y.second),
                texel(x.second, y.second)};
    }

    static NodeRange node(Index cell, const GridAxis& axis, int level) {
        const Index stored = stored_cell(cell, axis), index = stored >> level;
        const Index first = index << level;
        const Index end = std::min<Index>(first + (Index(1) << level), axis.count);
        constexpr double never = std::numeric_limits<double>::infinity();
        const Index origin = cell - stored;
        const bool begins = !axis.periodic && first == 0;
        const bool ends = !axis.periodic && end == axis.count;
        return {index, begins ? -never : static_cast<double>(origin + first),
                ends ? never : static_cast<double>(origin + end)};
    }
    /// The greatest height in a node, NaN if one is.
    double greatest(Index x, Index y, int level) const {
        return maxima_.texels[maxima_.offset[level] + y * maxima_.width[level] + x];
    }

  private:
    /// The two texels of an axis that a cell lies between; -1: the border.
    struct Taps {
        Index first, second;
    };
    static Index wrapped(Index i, Index texels, Wrap wrap) {
        if (wrap == Wrap::clamp_to_border && (i < 0 || i >= texels)) return -1;
        if (wrap == Wrap::mirrored_repeat && i >= texels) return 2 * texels - 1 - i;
        if (wrap == Wrap::mirror_once && i < 0) i = -1 - i;
        return std::clamp<Index>(i, 0, texels - 1);
    }
    static Taps taps(Index stored, const GridAxis& axis, Index texels, Wrap wrap) {
        const Index first = stored + axis.first;
        const Index next = axis.periodic ? (first + 1) % axis.count : first + 1;
        return {wrapped(first, texels, wrap), wrapped(next, texels, wrap)};
    }
    double texel(Index x, Index y) const {
        if (x < 0 || y < 0) return sampler_.border[0];
        return view_.texels[view_.offset[0] + (y * width() + x) * view_.channels];
    }

    const TextureView& view_;
    const TextureView& maxima_;
    const SamplerState& sampler_;
    Grid grid_;
};

}  // namespace quadrel::oracle
