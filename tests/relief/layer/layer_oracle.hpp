// The judge of searches through depth layers: where a ray first is inside of a solid between two
// layers. One text for long double and for rationals, whose only rounding is in square roots, of
// 2^-256; it shares nothing with the kernels' texts: cells come from the middles of intervals, and
// of every quadratic both roots are looked at.
#pragma once

#include <gmpxx.h>

#include <optional>

#include "relief/exact/oracle_exact.hpp"
#include "relief/layer/layer_maps.hpp"

namespace quadrel::test::oracle {

inline Real square_root(Real x) { return std::sqrt(x); }
inline mpq_class square_root(const mpq_class& x) {
    mpf_class root(0, 512);
    root = sqrt(mpf_class(x, 512));
    return mpq_class(root);
}
template <class N>
N number_of(Real x) {
    if constexpr (std::same_as<N, mpq_class>)
        return rational(x);
    else
        return x;
}
inline long floor_of(Real x) { return static_cast<long>(std::floor(x)); }

/// The layers of a map, as heights of a Field each.
class LayerField {
  public:
    LayerField(const SampledTexture& map, int layers)
        : layers_(std::min(layers, int(map.view.channels))) {
        for (int layer = 0; layer < layers_; ++layer) {
            SampledTexture& one = maps_[layer];
            one = map;
            one.view.texels += layer;
            one.sampler.border[0] = map.sampler.border[layer];
            fields_.emplace_back(one);
        }
    }
    LayerField(const LayerField&) = delete;

    int layers() const { return layers_; }
    const Field& layer(int i) const { return fields_[static_cast<std::size_t>(i)]; }

    /// Whether a pair has any thickness at the corners of a cell.
    bool is_solid(int pair, long i, long j) const {
        for (int corner = 0; corner < 4; ++corner)
            if (texel(2 * pair, corner, i, j) < texel(2 * pair + 1, corner, i, j)) return true;
        return false;
    }
    Real texel(int layer_of, int corner, long i, long j) const {
        return layer(layer_of).texel(i + corner % 2, j + corner / 2);
    }

  private:
    int layers_;
    SampledTexture maps_[4];
    std::vector<Field> fields_;
};

template <class N>
struct LayerRay {
    N x, y, dx, dy;

    LayerRay(const Field& field, const Ray& ray)
        : x((number_of<N>(ray.u) - number_of<N>(ray.s_polygon) * number_of<N>(ray.Ku)) *
                number_of<N>(field.width) -
            number_of<N>(0.5L)),
          y((number_of<N>(ray.v) - number_of<N>(ray.s_polygon) * number_of<N>(ray.Kv)) *
                number_of<N>(field.height) -
            number_of<N>(0.5L)),
          dx(number_of<N>(ray.Ku) * number_of<N>(field.width)),
          dy(number_of<N>(ray.Kv) * number_of<N>(field.height)) {}

    /// Along one axis: the first border after s, or 2.
    static N next_border(const N& start, const N& rate, const N& s) {
        if (rate == 0) return 2;
        const N at = start + rate * s;
        long border = floor_of(at);
        if (rate > 0) ++border;
        N next = (number_of<N>(static_cast<Real>(border)) - start) / rate;
        // On a border, or where it is but for rounding.
        while (!(next > s)) {
            border += rate > 0 ? 1 : -1;
            next = (number_of<N>(static_cast<Real>(border)) - start) / rate;
        }
        return next;
    }
};

template <class N>
struct LayerQuadratic {
    N A, B, C;
    N at(const N& t) const { return N(N(N(A * t) + B) * t) + C; }
};

/// The roots of q in (0, length].
template <class N>
std::vector<N> roots_of(const LayerQuadratic<N>& q, const N& length) {
    std::vector<N> roots;
    const auto keep = [&](const N& root) {
        if (root > 0 && !(root > length)) roots.push_back(root);
    };
    const N disc = q.B * q.B - 4 * q.A * q.C;
    if (disc < 0) return roots;
    const N root = square_root(disc);
    const N w = q.B < 0 ? N(root - q.B) : N(-root - q.B);
    if (w != 0) keep(2 * q.C / w);
    if (q.A != 0) keep(w / (2 * q.A));
    return roots;
}

/// First tau in [0, length] from which on the ray is inside of a solid, if there is one: above all
/// of [tau, the next change) below >= 0 and above > 0.
template <class N>
std::optional<N> enter_pair(const LayerQuadratic<N>& below, const LayerQuadratic<N>& above,
                            const N& length) {
    std::vector<N> changes{N(0)};
    for (const auto* q : {&below, &above})
        for (const N& root : roots_of(*q, length)) changes.push_back(root);
    changes.push_back(length);
    std::sort(changes.begin(), changes.end());
    if (below.C >= 0 && above.C > 0) return N(0);
    for (std::size_t k = 1; k < changes.size(); ++k) {
        if (!(changes[k] > changes[k - 1])) continue;
        const N middle = (changes[k - 1] + changes[k]) / 2;
        if (below.at(middle) > 0 && above.at(middle) > 0) return changes[k - 1];
    }
    return {};
}

/// `grow` is added to every solid that has any thickness in a cell, above and below.
template <class N>
LayerQuadratic<N> depth_quadratic(const LayerField& field, const LayerRay<N>& ray, int layer,
                                  long i, long j, const N& s, const N& grow) {
    N d[4];
    for (int corner = 0; corner < 4; ++corner)
        d[corner] = number_of<N>(field.texel(layer, corner, i, j)) + grow;
    const N b = d[1] - d[0], c = d[2] - d[0], e = d[0] - d[1] - d[2] + d[3];
    const N f = ray.x + ray.dx * s - number_of<N>(i), g = ray.y + ray.dy * s - number_of<N>(j);
    return {e * ray.dx * ray.dy, b * ray.dx + c * ray.dy + e * (f * ray.dy + g * ray.dx) - 1,
            d[0] + b * f + c * g + e * f * g - s};
}

struct LayerHit {
    Real s = std::numeric_limits<Real>::infinity();  ///< infinite: a miss
    bool found() const { return s <= 1; }
};

template <class N>
LayerHit meet_layers(const LayerField& field, const Ray& along, Real grow = 0) {
    const LayerRay<N> ray(field.layer(0), along);
    const N more = number_of<N>(grow);
    for (N s = 0; s < 1;) {
        N to = LayerRay<N>::next_border(ray.x, ray.dx, s);
        to = std::min(to, LayerRay<N>::next_border(ray.y, ray.dy, s));
        to = std::min(to, N(1));
        const N middle = (s + to) / 2, length = to - s;
        const long i = floor_of(N(ray.x + ray.dx * middle));
        const long j = floor_of(N(ray.y + ray.dy * middle));
        std::optional<N> first;
        for (int pair = 0; 2 * pair < field.layers(); ++pair) {
            if (!field.is_solid(pair, i, j)) continue;
            const auto front = depth_quadratic<N>(field, ray, 2 * pair, i, j, s, -more);
            const auto back = depth_quadratic<N>(field, ray, 2 * pair + 1, i, j, s, more);
            const auto tau = enter_pair<N>({-front.A, -front.B, -front.C}, back, length);
            if (tau && (!first || *tau < *first)) first = tau;
        }
        if (first) {
            const N hit = s + *first;
            if constexpr (std::same_as<N, mpq_class>)
                return {static_cast<Real>(hit.get_d())};
            else
                return {hit};
        }
        s = to;
    }
    return {};
}

/// First of n + 1 samples inside of a solid by more than `margin`.
inline LayerHit march_layers(const LayerField& field, const Ray& ray, int n, Real margin) {
    const LayerRay<Real> along(field.layer(0), ray);
    for (int k = 0; k <= n; ++k) {
        const Real s = static_cast<Real>(k) / n;
        const Real x = along.x + along.dx * s, y = along.y + along.dy * s;
        for (int pair = 0; pair < field.layers(); pair += 2)
            if (field.layer(pair).bilinear(x, y) < s - margin &&
                field.layer(pair + 1).bilinear(x, y) > s + margin)
                return {s};
    }
    return {};
}

}  // namespace quadrel::test::oracle
