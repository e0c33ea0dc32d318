#include "render/errors/layer_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "relief/oracle/heights.hpp"

namespace quadrel {
namespace {

constexpr int most_layer_cells = 1 << 16;
constexpr double least_stretch = 0x1p-20;

/// A depth, less the ray's, over a stretch of it: (a t + b) t + c, t from 0 to 1.
struct Parabola {
    double a, b, c;

    static Parabola through(double begin, double middle, double end) {
        const double a = 2 * (begin - 2 * middle + end);
        return {a, end - begin - a, begin};
    }
    double at(double t) const { return (a * t + b) * t + c; }
    void append_roots(std::vector<double>& roots) const {
        const double square = b * b - 4 * a * c;
        if (square < 0) return;
        const double w = -(b + std::copysign(std::sqrt(square), b)) / 2;
        for (const double root : {w / a, c / w})
            if (root > 0 && root < 1) roots.push_back(root);
    }
};

/// Each layer as a field of its own.
class JudgedLayers {
  public:
    JudgedLayers(const SampledTexture& map, int layers)
        : layers_(layers), stored_(std::min(layers, static_cast<int>(map.view.channels))) {
        for (int layer = 0; layer < stored_; ++layer) {
            SampledTexture& one = maps_[static_cast<std::size_t>(layer)];
            one = map;
            one.view.texels += layer;
            one.sampler.border[0] = map.sampler.border[layer];
        }
    }

    int layers() const { return layers_; }

    /// Those that the map lacks are at the bottom.
    oracle::Corners corners(int layer, oracle::Index i, oracle::Index j) const {
        if (layer >= stored_) return {1, 1, 1, 1};
        const SampledTexture& map = maps_[static_cast<std::size_t>(layer)];
        const oracle::Field field{&map, &map, oracle::Surface::bilinear};
        return oracle::Heights(field).corners(i, j);
    }
    double x(double u) const { return u * maps_[0].view.width[0] - 0.5; }
    double y(double v) const { return v * maps_[0].view.height[0] - 0.5; }
    double width() const { return maps_[0].view.width[0]; }
    double height() const { return maps_[0].view.height[0]; }

  private:
    int layers_, stored_;
    std::array<SampledTexture, 4> maps_{};
};

oracle::Index cell_of(double x) {
    constexpr double far = 0x1p60;
    return static_cast<oracle::Index>(std::floor(std::clamp(x, -far, far)));
}

double depth_at(const oracle::Corners& d, double f, double g) {
    return (d.h00 * (1 - f) + d.h10 * f) * (1 - g) + (d.h01 * (1 - f) + d.h11 * f) * g;
}

/// A ray in cells.
struct LayerWalk {
    const JudgedLayers& layers;
    double x, y, dx, dy;  ///< at s = 0, and their change

    LayerWalk(const JudgedLayers& all, const oracle::Ray& ray)
        : layers(all),
          x(all.x(ray.u - ray.s_polygon * ray.Ku)),
          y(all.y(ray.v - ray.s_polygon * ray.Kv)),
          dx(ray.Ku * all.width()),
          dy(ray.Kv * all.height()) {}

    /// The s > from where a position comes to the border of its cell.
    static double leaves(double start, double rate, oracle::Index cell, double from) {
        if (rate == 0) return std::numeric_limits<double>::infinity();
        const double s = (static_cast<double>(rate > 0 ? cell + 1 : cell) - start) / rate;
        return s > from ? s : std::numeric_limits<double>::infinity();
    }

    bool has_gap(double from, double to) const {
        int cells = 0;
        while (from < to && ++cells < most_layer_cells) {
            // The cell of a point within the next stretch, whatever rounding does at a border.
            const double probe = std::min(to, from + 0x1p-40);
            const oracle::Index i = cell_of(x + dx * probe), j = cell_of(y + dy * probe);
            const double end = std::min({to, leaves(x, dx, i, probe), leaves(y, dy, j, probe)});
            if (cell_has_gap(i, j, from, end)) return true;
            from = end;
        }
        return false;
    }

    bool cell_has_gap(oracle::Index i, oracle::Index j, double from, double to) const {
        std::vector<Parabola> sides;  // above 0 within a solid: below its front, above its back
        std::vector<double> changes{0, 1};
        for (int layer = 0; layer < layers.layers(); ++layer) {
            const oracle::Corners depths = layers.corners(layer, i, j);
            if (!depths.finite()) return false;
            const auto side = [&](double s) {
                const double below = s - depth_at(depths, x + dx * s - static_cast<double>(i),
                                                  y + dy * s - static_cast<double>(j));
                return layer % 2 == 0 ? below : -below;
            };
            sides.push_back(Parabola::through(side(from), side((from + to) / 2), side(to)));
            sides.back().append_roots(changes);
        }
        std::sort(changes.begin(), changes.end());
        for (std::size_t k = 1; k < changes.size(); ++k) {
            if (!((changes[k] - changes[k - 1]) * (to - from) > least_stretch)) continue;
            const double middle = (changes[k - 1] + changes[k]) / 2;
            bool inside = false;
            for (std::size_t pair = 0; pair + 1 < sides.size(); pair += 2)
                inside = inside || (sides[pair].at(middle) >= 0 && sides[pair + 1].at(middle) > 0);
            if (!inside) return true;
        }
        return false;
    }
};

}  // namespace

LayerSlope layer_slope(const SampledTexture& map, int layers, const oracle::Ray& ray, double u,
                       double v, double s) {
    const JudgedLayers all(map, layers);
    const double x = all.x(u), y = all.y(v);
    const oracle::Index i = cell_of(x), j = cell_of(y);
    const double f = x - static_cast<double>(i), g = y - static_cast<double>(j);
    LayerSlope slope;
    double nearest = std::numeric_limits<double>::infinity();
    for (int layer = 0; layer < layers; ++layer) {
        const oracle::Corners d = all.corners(layer, i, j);
        const double off = std::fabs(depth_at(d, f, g) - s);
        if (!(off < nearest)) continue;
        nearest = off;
        slope.gradient_u = ((d.h10 - d.h00) * (1 - g) + (d.h11 - d.h01) * g) * all.width();
        slope.gradient_v = ((d.h01 - d.h00) * (1 - f) + (d.h11 - d.h10) * f) * all.height();
    }
    const double rate = 1 - slope.gradient_u * ray.Ku - slope.gradient_v * ray.Kv;
    if (s > 0 && rate != 0) slope.condition = 1 / std::fabs(rate);
    return slope;
}

bool leaves_layers(const SampledTexture& map, int layers, const oracle::Ray& ray, double from,
                   double to) {
    from = std::max(from, 0.0);
    to = std::min(to, 1.0);
    if (!(from < to) || !std::isfinite(ray.u + ray.v + ray.Ku + ray.Kv)) return false;
    const JudgedLayers all(map, layers);
    return LayerWalk(all, ray).has_gap(from, to);
}

}  // namespace quadrel
