// The judge of searches: where a ray first meets a height field, for three readings of the same
// texels (blocks, bilinear patches, two triangles a cell). Plain scalar code in long double that
// shares nothing with the kernels' texts: borders of both axes merged in order, the cell of each
// interval taken from its middle.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "quadrel/texture/view.hpp"

namespace quadrel::test::oracle {

using Real = long double;

/// Level 0 of a height map, as the sampler's wrap modes continue it.
class Field {
  public:
    explicit Field(const SampledTexture& map)
        : width(map.view.width[0]), height(map.view.height[0]), map_(map) {}

    /// Height of any texel of the plane.
    Real texel(long i, long j) const {
        const SamplerState& s = map_.sampler;
        if (outside(i, width, s.wrap_u) || outside(j, height, s.wrap_v)) return s.border[0];
        const long x = wrapped(i, width, s.wrap_u), y = wrapped(j, height, s.wrap_v);
        return map_.view.texels[map_.view.offset[0] + (y * width + x) * map_.view.channels];
    }

    /// The bilinear field at x = u * width - 1/2, y = v * height - 1/2.
    Real bilinear(Real x, Real y) const {
        const Real i = std::floor(x), j = std::floor(y), f = x - i, g = y - j;
        const long a = static_cast<long>(i), b = static_cast<long>(j);
        return (texel(a, b) * (1 - f) + texel(a + 1, b) * f) * (1 - g) +
               (texel(a, b + 1) * (1 - f) + texel(a + 1, b + 1) * f) * g;
    }

    int width, height;

  private:
    static bool outside(long i, long n, Wrap wrap) {
        return wrap == Wrap::clamp_to_border && (i < 0 || i >= n);
    }
    static long wrapped(long i, long n, Wrap wrap) {
        if (wrap == Wrap::repeat) return ((i % n) + n) % n;
        if (wrap == Wrap::mirrored_repeat) {
            const long phase = ((i % (2 * n)) + 2 * n) % (2 * n);
            return phase < n ? phase : 2 * n - 1 - phase;
        }
        if (wrap == Wrap::mirror_once && i < 0) i = -1 - i;
        return std::clamp(i, 0L, n - 1);
    }

    const SampledTexture& map_;
};

/// uv(s) = uv + (s - s_polygon) K.
struct Ray {
    Real u, v, Ku, Kv, s_polygon = 0;
};

struct Hit {
    Real s = 1;
    bool found = false;  ///< false: below the bottom plane at s = 1
};

/// The ray over a grid: position start + rate * s, in cells.
struct GridRay {
    Real x, y, dx, dy;

    /// `centre`: 1/2 for dual cells, 0 for texels.
    GridRay(const Field& field, const Ray& ray, Real centre)
        : x((ray.u - ray.s_polygon * ray.Ku) * field.width - centre),
          y((ray.v - ray.s_polygon * ray.Kv) * field.height - centre),
          dx(ray.Ku * field.width),
          dy(ray.Kv * field.height) {}
};

/// Parameters at which one axis meets its borders, in order, from s = 0 on.
class Borders {
  public:
    Borders(Real start, Real rate)
        : start_(start),
          rate_(rate),
          next_(rate > 0 ? std::floor(start) + 1 : std::ceil(start) - 1) {}
    Real s() const {
        return rate_ == 0 ? std::numeric_limits<Real>::infinity() : (next_ - start_) / rate_;
    }
    void advance() { next_ += rate_ > 0 ? 1 : -1; }

  private:
    Real start_, rate_, next_;
};

/// Calls visit(i, j, from, to) for the cells on the way to s = 1 until it returns true. Intervals
/// of no length are left out.
inline bool walk(const GridRay& ray, const std::function<bool(long, long, Real, Real)>& visit) {
    Borders in_x(ray.x, ray.dx), in_y(ray.y, ray.dy);
    for (Real from = 0; from < 1;) {
        const Real to = std::min<Real>(1, std::min(in_x.s(), in_y.s()));
        const Real middle = (from + to) / 2;
        const auto cell = [middle](Real start, Real rate) {
            return static_cast<long>(std::floor(start + rate * middle));
        };
        if (to > from && visit(cell(ray.x, ray.dx), cell(ray.y, ray.dy), from, to)) return true;
        while (in_x.s() <= to) in_x.advance();
        while (in_y.s() <= to) in_y.advance();
        from = to;
    }
    return false;
}

/// First tau in [0, length] where A tau^2 + B tau + C >= 0, or infinity.
inline Real first_root(Real A, Real B, Real C, Real length) {
    const Real none = std::numeric_limits<Real>::infinity();
    if (C >= 0) return 0;
    const Real disc = B * B - 4 * A * C;
    if (disc < 0) return none;
    const Real w = B < 0 ? -B + std::sqrt(disc) : -B - std::sqrt(disc);
    Real first = none;
    for (const Real root : {A != 0 ? w / (2 * A) : none, w != 0 ? 2 * C / w : none})
        if (root >= 0) first = std::min(first, root);
    return first <= length ? first : none;
}

/// A surface h = a + b f + c g + d f g over a cell; part of the ray in it from s on.
inline Hit meet_patch(const Real (&h)[4], const GridRay& ray, long i, long j, Real s, Real to) {
    const Real f = ray.x + ray.dx * s - static_cast<Real>(i);
    const Real g = ray.y + ray.dy * s - static_cast<Real>(j);
    const Real b = h[1] - h[0], c = h[2] - h[0], d = h[0] - h[1] - h[2] + h[3];
    const Real A = d * ray.dx * ray.dy;
    const Real B = b * ray.dx + c * ray.dy + d * (f * ray.dy + g * ray.dx) + 1;
    const Real C = h[0] + b * f + c * g + d * f * g - (1 - s);
    const Real tau = first_root(A, B, C, to - s);
    return tau <= to - s ? Hit{s + tau, true} : Hit{};
}

/// The bilinear field raised by `lift`.
inline Hit meet_bilinear(const Field& field, const Ray& ray, Real lift = 0) {
    const GridRay grid(field, ray, 0.5L);
    Hit hit;
    walk(grid, [&](long i, long j, Real from, Real to) {
        const Real h[4] = {field.texel(i, j) + lift, field.texel(i + 1, j) + lift,
                           field.texel(i, j + 1) + lift, field.texel(i + 1, j + 1) + lift};
        hit = meet_patch(h, grid, i, j, from, to);
        return hit.found;
    });
    return hit;
}

/// Every texel a block: tops at their heights, walls between them.
inline Hit meet_blocks(const Field& field, const Ray& ray, Real lift = 0) {
    Hit hit;
    walk(GridRay(field, ray, 0), [&](long i, long j, Real from, Real to) {
        const Real h = field.texel(i, j) + lift;
        if (h >= 1 - from) {
            hit = {from, true};
        } else if (h >= 1 - to) {
            hit = {1 - h, true};
        }
        return hit.found;
    });
    return hit;
}

/// Which diagonal of a cell its two triangles share: from (0, 0) to (1, 1), the other one, or the
/// one whose ends differ less.
enum class Diagonal { main, anti, least };

/// Two triangles a cell.
inline Hit meet_triangles(const Field& field, const Ray& ray, Diagonal diagonal, Real lift = 0) {
    const GridRay grid(field, ray, 0.5L);
    const auto meet = [&](long i, long j, Real from, Real to) {
        const Real a = field.texel(i, j) + lift, b = field.texel(i + 1, j) + lift;
        const Real c = field.texel(i, j + 1) + lift, e = field.texel(i + 1, j + 1) + lift;
        const bool main = diagonal == Diagonal::main ||
                          (diagonal == Diagonal::least && std::fabs(a - e) <= std::fabs(b - c));
        const Real middle = (from + to) / 2;
        const Real f = grid.x + grid.dx * middle - static_cast<Real>(i);
        const Real g = grid.y + grid.dy * middle - static_cast<Real>(j);
        // Each triangle's plane, as a patch whose fourth corner lies in it.
        const Real lower[4] = {a, b, main ? a + e - b : c, main ? e : b + c - a};
        const Real upper[4] = {main ? a : b + c - e, main ? a + e - c : b, c, e};
        return meet_patch((main ? g < f : f + g < 1) ? lower : upper, grid, i, j, from, to);
    };
    Hit hit;
    walk(grid, [&](long i, long j, Real from, Real to) {
        const auto across = [&](Real at_zero, Real rate) {
            return rate == 0 ? to : -at_zero / rate;
        };
        const bool main_side = diagonal != Diagonal::anti;
        const Real x = grid.x - static_cast<Real>(i), y = grid.y - static_cast<Real>(j);
        Real cuts[2] = {across(x - y, grid.dx - grid.dy), across(x + y - 1, grid.dx + grid.dy)};
        // Where the diagonal is not this one, a cut changes nothing.
        if (!main_side) cuts[0] = to;
        std::sort(cuts, cuts + 2);
        Real start = from;
        for (const Real end : {cuts[0], cuts[1], to}) {
            if (hit.found || !(end > start) || end > to) continue;
            hit = meet(i, j, start, end);
            start = end;
        }
        return hit.found;
    });
    return hit;
}

/// First of n + 1 samples at or below the bilinear field.
inline Hit march(const Field& field, const Ray& ray, int n) {
    const GridRay grid(field, ray, 0.5L);
    for (int k = 0; k <= n; ++k) {
        const Real s = static_cast<Real>(k) / n;
        if (field.bilinear(grid.x + grid.dx * s, grid.y + grid.dy * s) >= 1 - s) return {s, true};
    }
    return {};
}

}  // namespace quadrel::test::oracle
