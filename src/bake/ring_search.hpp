// Visiting the texels around a texel, nearest rings first.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "bake/height_plane.hpp"

namespace quadrel {

/// Distances in tile units between texels by their offsets, and the least of a ring. Monotonic in
/// each offset, rounding included.
class TileMetric {
  public:
    TileMetric(int width, int height) : width_(width), height_(height) {}
    double operator()(double di, double dj) const {
        const double u = di / width_, v = dj / height_;
        return std::sqrt(u * u + v * v);
    }
    /// No texel of Chebyshev distance r or more is nearer.
    double ring(double r) const { return r / std::max(width_, height_); }

  private:
    double width_, height_;
};

/// Which of the texels that a stored one stands for are visited.
enum class Images {
    nearest,  ///< the one that is nearest to the centre of the search
    all,      ///< the whole plane: where the direction matters, and not the distance alone
};

/// Offsets along one axis, and the stored index that they lead to.
class OffsetRange {
  public:
    OffsetRange(int index, const GridAxis& axis, Images images)
        : low(images == Images::all ? -everywhere
              : axis.periodic       ? -(axis.count - 1) / 2
                                    : -index),
          high(images == Images::all ? everywhere
               : axis.periodic       ? axis.count / 2
                                     : axis.count - 1 - index),
          index_(index),
          axis_(axis) {}

    int at(int offset) const {
        int i = index_ + offset;
        if (!axis_.periodic) return std::clamp(i, 0, axis_.count - 1);
        while (i < 0) i += axis_.count;
        while (i >= axis_.count) i -= axis_.count;
        return i;
    }

    int low, high;

  private:
    static constexpr int everywhere = 1 << 29;
    int index_;
    GridAxis axis_;
};

/// Calls visit(di, dj) for the offsets of rings 1, 2, ... until done(ring) or all are visited;
/// with Images::all `done` has to end it.
template <class Done, class Visit>
void search_rings(const OffsetRange& u, const OffsetRange& v, const Done& done,
                  const Visit& visit) {
    const int last = std::max(std::max(-u.low, u.high), std::max(-v.low, v.high));
    for (int r = 1; r <= last; ++r) {
        if (done(r)) return;
        for (const int dj : {-r, r}) {
            if (dj < v.low || dj > v.high) continue;
            for (int di = std::max(-r, u.low); di <= std::min(r, u.high); ++di) visit(di, dj);
        }
        for (const int di : {-r, r}) {
            if (di < u.low || di > u.high) continue;
            for (int dj = std::max(1 - r, v.low); dj <= std::min(r - 1, v.high); ++dj)
                visit(di, dj);
        }
    }
}

}  // namespace quadrel
