// Baked maps on ranges: what cone maps, distances and horizons give anywhere in a range of places.
#pragma once

#include "quadrel/relief/trace/cone/stages.hpp"
#include "quadrel/relief/trace/search/range_walk.hpp"
#include "quadrel/texture/range/sampler.hpp"

namespace quadrel {

namespace range_detail {

/// Texels whose second channel is interpolated by its root.
class RootTexels {
  public:
    explicit RootTexels(const LevelTexels& of) : of_(of) {}

    TexelValue at(double i, double j) const {
        TexelValue value = of_.at(i, j);
        value.channel[1] = std::sqrt(std::max(value.channel[1], 0.0));
        return value;
    }

  private:
    const LevelTexels& of_;
};

/// What a layer of a baked map gives over ranges of coordinates, filtered linearly.
inline TexelRange layer_range(const SampledTexture& map, int layer, bool by_roots, const Ranged& u,
                              const Ranged& v) {
    const LevelTexels texels(map, 0, layer);
    const auto in_roots = [&](TexelRange range) {
        RealInterval& root = range.channel[1];
        if (by_roots) root = {std::sqrt(std::max(root.lo, 0.0)), std::sqrt(std::max(root.hi, 0.0))};
        return range;
    };
    if (!u.is_bounded() || !v.is_bounded()) return in_roots(whole_map(map));
    const RealInterval x = texel_coordinates(u.range(), texels.width(), map.sampler);
    const RealInterval y = texel_coordinates(v.range(), texels.height(), map.sampler);
    if (std::max(x.magnitude(), y.magnitude()) > coordinate_limit / 2)
        return in_roots(whole_map(map));
    TexelRange range = TexelRange::nothing();
    const bool done = by_roots ? include_linear(range, RootTexels(texels), x, y)
                               : include_linear(range, texels, x, y);
    return done ? range : in_roots(whole_map(map));
}

/// The same of any of several layers.
inline TexelRange layers_range(const SampledTexture& map, RangeInt::Lane layers, bool by_roots,
                               const Ranged& u, const Ranged& v) {
    const int first = std::clamp(layers.lo, 0, map.view.faces - 1);
    const int last = std::clamp(layers.hi, 0, map.view.faces - 1);
    TexelRange range = TexelRange::nothing();
    for (int layer = first; layer <= last; ++layer)
        range.include(layer_range(map, layer, by_roots, u, v));
    return filtered(range);
}

}  // namespace range_detail

template <TextureSlot slot, int channels, class Io, Interpolated what>
requires std::same_as<typename Io::Number, Ranges>
class BakedLookUp<slot, channels, Io, what> {
  public:
    using F = Ranges;

    explicit BakedLookUp(const Io& io) : map_(*io.template texture<slot>()) {}

    Texel<channels, F> operator()(const RangeMask& active, const vec2<F>& uv) const {
        return (*this)(active, uv, RangeInt(0));
    }
    Texel<channels, F> operator()(const RangeMask& active, const vec2<F>& uv,
                                  const RangeInt& layer) const {
        using namespace range_detail;
        constexpr bool by_roots = what == Interpolated::roots;
        Texel<channels, F> texel;
        for (F& channel : texel.channel) channel = F(Ranged::anything());
        for (int i = 0; i < 4; ++i) {
            if (active.lane[i].known().state == RangeTruth::no) continue;
            const TexelRange range =
                layers_range(map_, layer.lane[i], by_roots, uv.x.lane[i], uv.y.lane[i]);
            for (int c = 0; c < channels; ++c) texel.channel[c].lane[i] = Ranged(range.channel[c]);
        }
        if constexpr (by_roots) texel.channel[1] = squared(texel.channel[1]);
        return texel;
    }
    vec2<F> size() const { return {F(double(map_.view.width[0])), F(double(map_.view.height[0]))}; }

  private:
    /// Of roots that are not below 0, with what the roots of taps are off by.
    static F squared(const F& roots) {
        const F off = sqrt(roots * roots);
        const F square = off * off;
        F result = square;
        for (int i = 0; i < 4; ++i) {
            if (!square.lane[i].is_bounded()) continue;
            const RealInterval x = square.lane[i].range();
            result.lane[i] = Ranged(std::max(x.lo, 0.0), std::max(x.hi, 0.0));
        }
        return result;
    }

    const SampledTexture& map_;
};

template <TextureSlot slot, class Io>
requires std::same_as<typename Io::Number, Ranges>
class DistanceVolume<slot, Io> {
  public:
    using F = Ranges;

    explicit DistanceVolume(const Io& io) : map_(*io.template texture<slot>()) {}

    F layers() const { return F(double(map_.view.faces)); }
    vec2<F> size() const { return {F(double(map_.view.width[0])), F(double(map_.view.height[0]))}; }
    F operator()(const RangeMask& active, const vec2<F>& uv, const F& z) const {
        using namespace range_detail;
        const F at = clamp(z * layers() - F(0.5), F(0), layers() - F(1));
        F result(Ranged::anything());
        for (int i = 0; i < 4; ++i) {
            if (active.lane[i].known().state == RangeTruth::no || !at.lane[i].is_bounded())
                continue;
            const RealInterval k = at.lane[i].range();
            const double last = map_.view.faces - 1;
            TexelRange range = TexelRange::nothing();
            for (double below = std::floor(std::max(k.lo, 0.0)); below <= std::min(k.hi, last);
                 ++below) {
                const auto layer = [&](double l) {
                    return layer_range(map_, static_cast<int>(std::min(l, last)), false,
                                       uv.x.lane[i], uv.y.lane[i]);
                };
                range.include(blended(layer(below), layer(below + 1), weights_in(k, below)));
            }
            result.lane[i] = Ranged(filtered(range).channel[0]);
        }
        return result;
    }

  private:
    const SampledTexture& map_;
};

}  // namespace quadrel
