// Tables of a volume over a height field by place, height and direction: how they lie in a texture,
// and how they are read.
//
// A direction is that of a view ray, k = K / depth, the shift in tiles while the ray falls by
// `depth`. Directions fill a square: d = (k, 1) / (|k.x| + |k.y| + 1), and the square's coordinates
// are (d.x + d.y, d.x - d.y), over what they are at |k.x| + |k.y| = flattest_direction. Straight
// down is the middle, flatter rays are outside. Source: Cigolle, Donow, Evangelakos, Mara, McGuire,
// Meyer, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014,
// the octahedral map of a hemisphere.
//
// Layer k of `slices` is a slice of heights, or a curvature. Level 0 holds a picture of columns x
// rows for each direction, that of direction (a, b) from texel (a columns, b rows) on; level 1 has
// columns x rows, and level 2 two texels, the table's `depth` and its greatest curvature, or 0. So
// the sizes of the levels say what a table is.
#pragma once

#include "quadrel/relief/cells.hpp"

namespace quadrel {

/// |k.x| + |k.y| at the border of the square of directions.
inline constexpr double flattest_direction = 16;
/// |d.x| + |d.y| there.
inline constexpr double square_reach = flattest_direction / (1 + flattest_direction);

/// Coordinates in [-1, 1] of a direction; beyond, but finite, of flatter ones. k is finite.
template <Number F>
vec2<F> square_of_direction(const vec2<F>& k) {
    const F scale = F(1 / square_reach) / (abs(k.x) + abs(k.y) + F(1));
    return {(k.x + k.y) * scale, (k.x - k.y) * scale};
}

/// The direction k at coordinates whose magnitudes are below 1 / square_reach.
inline vec2<double> direction_of_square(double e, double f) {
    const double x = e * square_reach, y = f * square_reach;
    const double down = 1 - std::max(std::fabs(x), std::fabs(y));
    return {(x + y) / (2 * down), (x - y) / (2 * down)};
}

/// How many stored cells or texels of an axis make up a block, where `blocks` cover `count`.
constexpr std::int32_t block_side(std::int32_t count, std::int32_t blocks) {
    return (count + blocks - 1) / blocks;
}

/// A table as kernels read it.
template <Number F>
class DirectionTable {
  public:
    explicit DirectionTable(const TextureView& view)
        : view_(view),
          depth_(only_channel<F>(view, Int<F>(view.offset[2]))),
          curvature_(only_channel<F>(view, Int<F>(view.offset[2] + 1))) {}

    std::int32_t columns() const { return view_.width[1]; }
    std::int32_t rows() const { return view_.height[1]; }
    std::int32_t slices() const { return view_.faces; }
    /// Directions along a side of the square.
    std::int32_t directions() const { return view_.width[0] / view_.width[1]; }
    F depth() const { return depth_; }
    /// Slices of a view-dependent map are curvatures, from -curvature() to curvature().
    F curvature() const { return curvature_; }

    /// The value of column i, row j, slice k for direction (a, b), all of them stored.
    F at(Int<F> i, Int<F> j, Int<F> k, Int<F> a, Int<F> b) const {
        const Int<F> row = k * Int<F>(view_.height[0]) + b * Int<F>(rows()) + j;
        const Int<F> texel = row * Int<F>(view_.width[0]) + a * Int<F>(columns()) + i;
        return only_channel<F>(view_, texel);
    }

    /// The slice that height z lies in: the k-th reaches from k / slices to (k + 1) / slices.
    Int<F> slice(F z) const {
        const F count(static_cast<Scalar<F>>(slices()));
        return to_int(clamp(ceil(z * count) - F(1), F(0), count - F(1)));
    }

  private:
    const TextureView& view_;
    F depth_, curvature_;
};

}  // namespace quadrel
