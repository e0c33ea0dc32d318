// The lattice of a displacement's cells: places in integers, heights at its points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

#include "quadrel/scene/displace.hpp"
#include "quadrel/texture/address.hpp"

namespace quadrel::displacement {

__extension__ typedef __int128 Int128;  // NOLINT: the only way to spell it without a warning

/// Integers in a cell's width: fine enough for any picture, and products of two still fit Int128.
inline constexpr std::int64_t one = std::int64_t(1) << 20;

/// A point of texture space in 1 / `one` of a cell; lattice points are multiples of `one`.
struct Place {
    std::int64_t x = 0, y = 0;
    friend Place operator-(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }
    bool operator==(const Place&) const = default;
};

inline std::int64_t floor_cell(std::int64_t x) { return x >> 20; }

/// Which side of the line from a to b p is on: positive to the left.
inline Int128 side_of(const Place& a, const Place& b, const Place& p) {
    const Place d = b - a, q = p - a;
    return Int128(d.x) * q.y - Int128(d.y) * q.x;
}

/// An exact part of an edge.
struct Fraction {
    std::int64_t numerator = 0, denominator = 1;  ///< the latter above 0

    double value() const {
        return static_cast<double>(numerator) / static_cast<double>(denominator);
    }
    Fraction from_other_end() const { return {denominator - numerator, denominator}; }
    friend bool operator<(const Fraction& a, const Fraction& b) {
        return Int128(a.numerator) * b.denominator < Int128(b.numerator) * a.denominator;
    }
    friend bool operator==(const Fraction& a, const Fraction& b) {
        return Int128(a.numerator) * b.denominator == Int128(b.numerator) * a.denominator;
    }
};

/// Where a value that goes from `from` to `to` is `at`; the ends differ.
inline Fraction crossing(std::int64_t from, std::int64_t to, std::int64_t at) {
    return to > from ? Fraction{at - from, to - from} : Fraction{from - at, from - to};
}

/// Heights at the points of the lattice, and between them.
class Lattice {
  public:
    explicit Lattice(const Displacement& d)
        : map_(*d.heights),
          cells_(d.cells),
          split_(d.split),
          scale_(d.cells > 0 ? glm::dvec2(d.cells)
                             : glm::dvec2(map_.view.width[0], map_.view.height[0])),
          origin_(d.cells > 0 ? 0 : 0.5) {}

    /// In cells from the lattice's origin.
    glm::dvec2 in_cells(const glm::vec2& uv) const {
        return {double(uv.x) * scale_.x - origin_, double(uv.y) * scale_.y - origin_};
    }
    Place place(const glm::vec2& uv) const {
        const glm::dvec2 at = in_cells(uv);
        return {std::llround(at.x * double(one)), std::llround(at.y * double(one))};
    }

    double at(std::int64_t i, std::int64_t j) const {
        if (cells_ == 0) return texel(i, j);
        return between_texels(cell_corner(i, map_.sampler.wrap_u, map_.view.width[0]),
                              cell_corner(j, map_.sampler.wrap_v, map_.view.height[0]));
    }

    bool has_main_diagonal(std::int64_t i, std::int64_t j) const {
        if (split_ != CellSplit::min) return split_ == CellSplit::main;
        return std::fabs(at(i, j) - at(i + 1, j + 1)) <= std::fabs(at(i + 1, j) - at(i, j + 1));
    }

    /// Anywhere, by the triangle of its cell.
    double height(const Place& p) const {
        const std::int64_t i = floor_cell(p.x), j = floor_cell(p.y);
        const double f = part(p.x - i * one), g = part(p.y - j * one);
        const double h10 = at(i + 1, j), h01 = at(i, j + 1);
        if (has_main_diagonal(i, j)) {
            const double h00 = at(i, j), h11 = at(i + 1, j + 1);
            return f >= g ? h00 + f * (h10 - h00) + g * (h11 - h10)
                          : h00 + f * (h11 - h01) + g * (h01 - h00);
        }
        if (f + g <= 1) {
            const double h00 = at(i, j);
            return h00 + f * (h10 - h00) + g * (h01 - h00);
        }
        const double h11 = at(i + 1, j + 1);
        return h11 + (1 - f) * (h01 - h11) + (1 - g) * (h10 - h11);
    }

    static double part(std::int64_t of_a_cell) {
        return static_cast<double>(of_a_cell) / static_cast<double>(one);
    }

  private:
    /// -1: the border.
    static int texel_index(std::int64_t i, int n, Wrap wrap) {
        if (is_periodic(wrap)) {
            const std::int64_t period = wrap == Wrap::repeat ? n : 2 * std::int64_t(n);
            i = (i % period + period) % period;
        }
        i = std::clamp<std::int64_t>(i, -std::int64_t(n) - 1, 2 * std::int64_t(n));
        const auto index = static_cast<std::int32_t>(i);
        if (!inside_level<float>(index, n, wrap)) return -1;
        return wrap_index<float>(index, n, wrap);
    }
    double texel(std::int64_t i, std::int64_t j) const {
        const TextureView& view = map_.view;
        const int x = texel_index(i, view.width[0], map_.sampler.wrap_u);
        const int y = texel_index(j, view.height[0], map_.sampler.wrap_v);
        if (x < 0 || y < 0) return map_.sampler.border[0];
        const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(view.width[0]) +
                           static_cast<std::size_t>(x);
        return view.texels[static_cast<std::size_t>(view.offset[0]) +
                           index * static_cast<std::size_t>(view.channels)];
    }
    /// Corner `k` of a tile's cells in texels from the centre of the first; the same a period on.
    double cell_corner(std::int64_t k, Wrap wrap, int texels) const {
        if (is_periodic(wrap)) {
            const std::int64_t period = wrap == Wrap::repeat ? cells_ : 2 * std::int64_t(cells_);
            k = (k % period + period) % period;
        }
        return static_cast<double>(k * texels) / cells_ - 0.5;
    }
    double between_texels(double x, double y) const {
        const double left = std::floor(x), below = std::floor(y), f = x - left, g = y - below;
        const auto i = static_cast<std::int64_t>(left), j = static_cast<std::int64_t>(below);
        const auto along = [&](std::int64_t row) {
            const double first = texel(i, row);
            return first + f * (texel(i + 1, row) - first);
        };
        const double first = along(j);
        return first + g * (along(j + 1) - first);
    }

    const SampledTexture& map_;
    int cells_;
    CellSplit split_;
    glm::dvec2 scale_;
    double origin_;
};

}  // namespace quadrel::displacement
