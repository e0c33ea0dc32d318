// Whether a light is hidden, for all rays of a range: what an exact search towards it may give,
// however it gets there.
//
// Parts of the way up are halved until the field is certainly below the rays, or certainly above
// one point of each, or the part is short. Where the rays start they are on the field itself: there
// it rises above them or does not by its slope along them, whatever its height is.
#pragma once

#include "quadrel/relief/shadow/exact.hpp"
#include "quadrel/relief/trace/oracle/stages.hpp"
#include "quadrel/relief/trace/search/range_first_hit.hpp"

namespace quadrel {

namespace range_detail {

/// Rays from the bilinear field of level 0 at u, v upwards: at t in (0, 1 - z] they are at height
/// z + t, z the field's height where they start.
class RisingRays {
  public:
    enum Answer { lit, dark, either };

    RisingRays(const SampledTexture& map, const RealInterval (&uv)[2], const RealInterval (&K)[2])
        : field_(map, oracle::Surface::bilinear),
          x_{uv[0], K[0], field_.texels().width(), 0},
          y_{uv[1], K[1], field_.texels().height(), 0} {}

    Answer answer() {
        const double speed = std::max(x_.speed(), y_.speed());
        const double box = std::max(x_.width(), y_.width());
        if (!(speed < most_texels_crossed && box < most_texels_crossed)) return either;
        start_ = field_(x_.over(0, 0), y_.over(0, 0));
        if (!std::isfinite(start_.width())) return either;
        const double top = 1 - start_.lo;
        if (top <= 0) return lit;
        shortest_ =
            std::clamp(std::max(1.0 / 64, box / 8) / std::max(speed, 1e-9), 0x1p-20, 0x1p-12);
        // Rays that start above the top search nothing.
        const Answer found = from_start(top);
        return found == dark && start_.hi + height_slack(start_) >= 1 ? either : found;
    }

  private:
    static constexpr double most_texels_crossed = 0x1p17;
    static constexpr int most_looks = 1 << 14;

    /// The longest first part over which slopes decide, and the rest by heights.
    Answer from_start(double top) {
        for (double to = top; to > shortest_ / 16; to /= 2) {
            const RealInterval slope = slope_over(to);
            if (slope.lo > 1 + slope_slack(slope)) return dark;
            if (slope.hi < 1 - slope_slack(slope)) return to == top ? lit : over(to, top);
        }
        return over(0, top) == dark ? dark : either;
    }

    /// Over all rays from 0 to `to`, how much the field rises as t does.
    RealInterval slope_over(double to) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        PatchGradients gradients;
        if (!gradients_over(gradients, field_.texels(), x_.over(0, to), y_.over(0, to),
                            most_patches))
            return {-infinity, infinity};
        return gradients.x[0] * (x_.rate * RealInterval(x_.texels)) +
               gradients.y[0] * (y_.rate * RealInterval(y_.texels));
    }
    static double slope_slack(const RealInterval& slope) {
        return 16 * RayAxis::roundings() * (1 + slope.magnitude());
    }

    /// By heights alone: lit if the field is below all rays all along, dark if at some t it is
    /// above all of them.
    Answer over(double from, double to) {
        const RealInterval all = field_(x_.over(from, to), y_.over(from, to));
        const double slack = height_slack(all) + height_slack(start_);
        if (!std::isfinite(all.width())) return either;
        if (all.hi < start_.lo + from - slack) return lit;
        const RealInterval end = field_(x_.over(to, to), y_.over(to, to));
        if (end.lo > start_.hi + to + slack && start_.hi + to < 1) return dark;
        if (to - from <= shortest_ || ++looks_ >= most_looks) return either;
        const double middle = from + (to - from) / 2;
        const Answer first = over(from, middle);
        if (first == dark) return dark;
        const Answer second = over(middle, to);
        if (second == dark) return dark;
        return first == lit && second == lit ? lit : either;
    }

    FieldRange field_;
    RayAxis x_, y_;
    RealInterval start_{0, 0};
    double shortest_ = 1;
    int looks_ = 0;
};

/// Whether the lane's light may be seen; open where it may and may not.
inline RangeTruth is_dark(const SampledTexture& map, const LightRay<Ranges>& light, int lane) {
    const Ranged numbers[4] = {light.uv.x.lane[lane], light.uv.y.lane[lane], light.K.x.lane[lane],
                               light.K.y.lane[lane]};
    for (const Ranged& number : numbers)
        if (!number.is_bounded()) return RangeTruth::undecided(lane);
    RisingRays rays(map, {numbers[0].range(), numbers[1].range()},
                    {numbers[2].range(), numbers[3].range()});
    const RisingRays::Answer answer = rays.answer();
    if (answer == RisingRays::either) return RangeTruth::undecided(lane);
    return answer == RisingRays::dark;
}

/// Stores what the lanes' lights are: hidden where `dark`, of lanes that ask.
template <class Io, class Dark>
void store_rising(const Io& io, const Dark& dark) {
    const LightRay<Ranges> light = light_ray(io);
    RangeMask hidden(false);
    for (int lane = 0; lane < 4; ++lane)
        if (light.active.lane[lane].known().state != RangeTruth::no)
            hidden.lane[lane] = both(light.active.lane[lane], dark(light, lane));
    store_shadow(io, light, select(hidden, Ranges(0), Ranges(1)), any_count());
}

}  // namespace range_detail

struct ShadowExactOnRanges : ShadowExact {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        range_detail::store_rising(io, [&](const LightRay<Ranges>& light, int lane) {
            return range_detail::is_dark(map, light, lane);
        });
    }
};

/// Of other surfaces than patches: hidden or not.
struct ShadowOracleOnRanges : ShadowOracle {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const bool patches = params.surface == static_cast<int>(oracle::Surface::bilinear);
        range_detail::store_rising(io, [&](const LightRay<Ranges>& light, int lane) {
            return patches ? range_detail::is_dark(map, light, lane) : RangeTruth::undecided(lane);
        });
    }
};

}  // namespace quadrel
