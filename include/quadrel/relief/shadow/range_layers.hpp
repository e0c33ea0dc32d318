// Whether a light is hidden by solids between depth layers, for all rays of a range.
//
// A ray starts on one of the layers. Over the first part of its way the layer's slope says on which
// side of it the ray goes on; of the other solid, and of both from there on, depths decide
// (range_rising.hpp).
#pragma once

#include "quadrel/relief/shadow/layers_exact.hpp"
#include "quadrel/relief/shadow/range_rising.hpp"
#include "quadrel/relief/trace/layer/range_solids.hpp"

namespace quadrel {

namespace range_detail {

/// Rays from u, v and a layer near depth s there, upwards: at t they are at depth d - t.
class RisingThroughLayers {
  public:
    using Answer = RisingRays::Answer;

    RisingThroughLayers(const SampledTexture& map, const RealInterval (&uv)[2],
                        const RealInterval (&K)[2], const RealInterval& s)
        : layers_(map),
          at_{{uv[0], K[0], layers_.texels().width(), 0},
              {uv[1], K[1], layers_.texels().height(), 0}},
          s_(s) {}

    Answer answer() {
        if (!at_.are_short()) return RisingRays::either;
        const LayerBox here = over(0, 0);
        const int own = own_layer(here);
        if (!here.is_finite() || own < 0) return RisingRays::either;
        start_ = here.depth[own];
        slack_ = 2 * depth_slack(here);
        shortest_ = std::clamp(std::max(1.0 / 64, at_.box() / 8) / std::max(at_.speed(), 1e-9),
                               0x1p-20, 0x1p-12);
        if (start_.hi <= 0) return RisingRays::lit;
        const Answer found = from_start(here, own);
        // Rays that start at the top search nothing.
        return found == RisingRays::dark && start_.lo <= slack_ ? RisingRays::either : found;
    }

  private:
    static constexpr int most_looks = 1 << 14;

    LayerBox over(double from, double to) const {
        return layers_(at_.x.over(from, to), at_.y.over(from, to));
    }
    RealInterval depths(double from, double to) const { return {start_.lo - to, start_.hi - from}; }

    /// The layer that is next to the hit; negative where it may be one or another.
    int own_layer(const LayerBox& box) const {
        double least[4], most[4];
        int own = 0;
        for (int layer = 0; layer < 4; ++layer) {
            const RealInterval apart = box.depth[layer] - s_;
            least[layer] =
                apart.has_zero() ? 0 : std::min(std::fabs(apart.lo), std::fabs(apart.hi));
            most[layer] = apart.magnitude();
            if (most[layer] < most[own]) own = layer;
        }
        for (int layer = 0; layer < 4; ++layer)
            if (layer != own && !(least[layer] > most[own])) return -1;
        return own;
    }

    Answer from_start(const LayerBox& here, int own) {
        const int pair = own / 2;
        const bool is_front = own % 2 == 0;
        for (double to = start_.hi; to > shortest_ / 16; to /= 2) {
            const RealInterval slope = slope_over(own, to);
            const double off = 16 * RayAxis::roundings() * (1 + slope.magnitude());
            const bool sinks = slope.lo > -1 + off, climbs = slope.hi < -1 - off;
            if (!sinks && !climbs) continue;
            // Above a front, or behind a back that climbs faster, the ray is outside.
            const bool outside = is_front ? sinks : climbs;
            const RealInterval& other = here.depth[is_front ? own + 1 : own - 1];
            if (!outside)
                return (is_front ? other.lo > start_.hi + slack_ : other.hi < start_.lo - slack_)
                           ? RisingRays::dark
                           : RisingRays::either;
            const LayerBox first = over(0, to);
            if (!first.is_finite()) return RisingRays::either;
            if (first.may_hold(1 - pair, depths(0, to), slack_)) continue;
            return to == start_.hi ? RisingRays::lit : beyond(to, start_.hi);
        }
        return beyond(0, start_.hi) == RisingRays::dark ? RisingRays::dark : RisingRays::either;
    }

    /// Over all rays from 0 to `to`, how much a layer's depth grows as t does.
    RealInterval slope_over(int layer, double to) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        PatchGradients gradients;
        if (!gradients_over(gradients, layers_.texels(), at_.x.over(0, to), at_.y.over(0, to),
                            most_patches))
            return {-infinity, infinity};
        return gradients.x[layer] * (at_.x.rate * RealInterval(at_.x.texels)) +
               gradients.y[layer] * (at_.y.rate * RealInterval(at_.y.texels));
    }

    /// By depths alone.
    Answer beyond(double from, double to) {
        const LayerBox all = over(from, to);
        if (!all.is_finite()) return RisingRays::either;
        const RealInterval part = depths(from, to);
        if (!all.may_hold(0, part, slack_) && !all.may_hold(1, part, slack_))
            return RisingRays::lit;
        const LayerBox end = over(to, to);
        const RealInterval at_end = depths(to, to);
        const bool inside = end.holds(0, at_end, slack_) || end.holds(1, at_end, slack_);
        if (inside && to < start_.lo) return RisingRays::dark;
        if (to - from <= shortest_ || ++looks_ >= most_looks) return RisingRays::either;
        const double middle = from + (to - from) / 2;
        const Answer first = beyond(from, middle);
        if (first == RisingRays::dark) return first;
        const Answer second = beyond(middle, to);
        if (second == RisingRays::dark) return second;
        return first == RisingRays::lit ? second : first;
    }

    LayerRanges layers_;
    RayPlaces at_;
    RealInterval s_, start_{0, 0};
    double slack_ = 0, shortest_ = 1;
    int looks_ = 0;
};

}  // namespace range_detail

struct ShadowLayersExactOnRanges : ShadowLayersExact {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using namespace range_detail;
        const SampledTexture& map = layer_map(io);
        const Ranges s = io.template load<Value::hit_s>();
        store_rising(io, [&](const LightRay<Ranges>& light, int lane) {
            const Ranged numbers[5] = {light.uv.x.lane[lane], light.uv.y.lane[lane],
                                       light.K.x.lane[lane], light.K.y.lane[lane], s.lane[lane]};
            for (const Ranged& number : numbers)
                if (!number.is_bounded()) return RangeTruth::undecided(lane);
            RisingThroughLayers rays(map, {numbers[0].range(), numbers[1].range()},
                                     {numbers[2].range(), numbers[3].range()}, numbers[4].range());
            const RisingRays::Answer answer = rays.answer();
            return answer == RisingRays::either ? RangeTruth::undecided(lane)
                                                : RangeTruth(answer == RisingRays::dark);
        });
    }
};

}  // namespace quadrel
