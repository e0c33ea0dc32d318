// The first solids between depth layers that all rays of a range meet: what an exact search through
// layers may give, however it gets there (range_first_hit.hpp).
#pragma once

#include "quadrel/relief/trace/layer/stages.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"

namespace quadrel {

namespace range_detail {

/// Texels as depths: those that a map lacks are at the bottom.
class DepthTexels {
  public:
    explicit DepthTexels(const SampledTexture& map)
        : level_(map, 0), channels_(map.view.channels) {}

    TexelValue at(double i, double j) const {
        const TexelValue texel = level_.at(i, j);
        if (channels_ == 4) return texel;
        return {{texel.channel[0], channels_ == 1 ? 1 : texel.channel[1], 1, 1}};
    }
    std::int32_t width() const { return level_.width(); }
    std::int32_t height() const { return level_.height(); }
    const SamplerState& sampler() const { return level_.sampler(); }

  private:
    LevelTexels level_;
    std::int32_t channels_;
};

/// How thick the two solids of a texel are.
class ThicknessTexels {
  public:
    explicit ThicknessTexels(const DepthTexels& depths) : depths_(depths) {}
    TexelValue at(double i, double j) const {
        const TexelValue d = depths_.at(i, j);
        return {{d.channel[1] - d.channel[0], d.channel[3] - d.channel[2], 0, 0}};
    }

  private:
    const DepthTexels& depths_;
};

/// The layers in a box, in texels.
struct LayerBox {
    RealInterval depth[4];
    RealInterval thickness[2];

    /// Whether anything in `depths` may be in a solid, and whether everything is.
    bool may_hold(int pair, const RealInterval& depths, double slack) const {
        const RealInterval &front = depth[2 * pair], &back = depth[2 * pair + 1];
        return thickness[pair].hi > 0 && front.lo <= depths.hi + slack &&
               back.hi > depths.lo - slack;
    }
    bool holds(int pair, const RealInterval& depths, double slack) const {
        return depth[2 * pair].hi <= depths.lo - slack &&
               depth[2 * pair + 1].lo > depths.hi + slack;
    }
    bool is_finite() const {
        for (const RealInterval& x : depth)
            if (!std::isfinite(x.width())) return false;
        return true;
    }
};
/// What depths are off by.
inline double depth_slack(const LayerBox& box) {
    double slack = 0;
    for (const RealInterval& x : box.depth) slack = std::max(slack, height_slack(x));
    return slack;
}

class LayerRanges {
  public:
    explicit LayerRanges(const SampledTexture& map) : map_(map), texels_(map) {}

    const DepthTexels& texels() const { return texels_; }

    LayerBox operator()(const RealInterval& x, const RealInterval& y) const {
        TexelRange depths = TexelRange::nothing(), thickness = TexelRange::nothing();
        LayerBox box;
        if (!include_linear(depths, texels_, x, y)) return everywhere();
        include_linear(thickness, ThicknessTexels(texels_), x, y);
        std::copy_n(depths.channel, 4, box.depth);
        std::copy_n(thickness.channel, 2, box.thickness);
        return box;
    }

  private:
    LayerBox everywhere() const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const TexelRange& all = whole_map(map_);
        LayerBox box;
        for (int layer = 0; layer < 4; ++layer)
            box.depth[layer] = layer < map_.view.channels ? all.channel[layer] : RealInterval(1);
        for (RealInterval& pair : box.thickness) pair = {-infinity, infinity};
        return box;
    }

    const SampledTexture& map_;
    DepthTexels texels_;
};

/// The first `pairs` of the solids, for rays from the top down.
class LayerHits {
  public:
    LayerHits(const SampledTexture& map, int pairs, const oracle::RayRange& rays)
        : layers_(map),
          pairs_(pairs),
          at_{{rays.u, rays.Ku, layers_.texels().width(), rays.s_polygon},
              {rays.v, rays.Kv, layers_.texels().height(), rays.s_polygon}} {}

    const RayPlaces& places() const { return at_; }

    Meets meets(double from, double to) const {
        const LayerBox box = over(from, to);
        if (!box.is_finite()) return Meets::unknown;
        const double slack = depth_slack(box);
        for (int pair = 0; pair < pairs_; ++pair)
            if (box.may_hold(pair, {from, to}, slack)) return Meets::some;
        return Meets::none;
    }
    bool holds_all(double at) const {
        const LayerBox box = over(at, at);
        const double slack = depth_slack(box);
        for (int pair = 0; pair < pairs_; ++pair)
            if (box.holds(pair, at, slack)) return true;
        return false;
    }
    /// Of a ray that begins inside, that of the layer next to it.
    RealInterval height_in(const RealInterval& s) const {
        RealInterval height(1 - s.hi, 1 - s.lo);
        if (s.lo == 0) {
            const LayerBox start = over(0, 0);
            for (int layer = 0; layer < 2 * pairs_; ++layer)
                height = hull(height, RealInterval(1) - start.depth[layer]);
        }
        return widened(height, height_slack(height));
    }

  private:
    LayerBox over(double from, double to) const {
        return layers_(at_.x.over(from, to), at_.y.over(from, to));
    }

    LayerRanges layers_;
    int pairs_;
    RayPlaces at_;
};

}  // namespace range_detail

/// An exact search of the first `pairs` solids.
template <class Row, int pairs>
struct LayersOnRanges : Row {
    template <class Io>
    void operator()(Io& io, const typename Row::Params&) const {
        using namespace range_detail;
        const SearchRay<Ranges> ray = search_ray(io);
        SearchResult<Ranges> result;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
            take_any_hit(lane, result);
            if (const auto rays = ray_range(ray, lane))
                take_first_hits(LayerHits(layer_map(io), pairs, *rays), Status::clip, lane, result);
        }
        result.flags = any_flags();
        result.steps = result.fetches = any_count();
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
