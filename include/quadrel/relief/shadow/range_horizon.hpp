// The horizon towards a direction on ranges: which azimuths it may lie between, and all that is
// interpolated there.
//
// Where a specification says nothing of how precise an angle is, it is still one: the horizon is
// one of those all around.
#pragma once

#include "quadrel/relief/shadow/horizon.hpp"
#include "quadrel/relief/trace/cone/range_baked_maps.hpp"

namespace quadrel {

namespace range_detail {

/// The direction's part of a turn, counted from 0 to 1 or, around the beginning of turns, from
/// below 0 or beyond 1; `lo + 1` or more: any.
inline RealInterval turn_range(const Ranged& x, const Ranged& y) {
    constexpr double half_turn = 3.14159265358979323846;
    const RealInterval any(0, 1);
    const double units = budget().arctangent;
    if (!x.is_bounded() || !y.is_bounded() || !(units < std::numeric_limits<double>::infinity()))
        return any;
    const RealInterval run = x.range(), rise = y.range();
    if (run.has_zero() && rise.has_zero()) return any;
    // Seen from the origin, a box that does not hold it ends at two corners.
    const double middle = atan2(rise.middle(), run.middle());
    double least = 0, most = 0;
    for (const double a : {run.lo, run.hi})
        for (const double b : {rise.lo, rise.hi}) {
            double off = atan2(b, a) - middle;
            if (off > half_turn) off -= 2 * half_turn;
            if (off < -half_turn) off += 2 * half_turn;
            least = std::min(least, off);
            most = std::max(most, off);
        }
    const double error = units * 0x1p-23 * half_turn + (budget().unit > 0 ? 0x1p-20 : 0x1p-40);
    return {(middle + least - error) / (2 * half_turn), (middle + most + error) / (2 * half_turn)};
}

}  // namespace range_detail

template <class Io>
requires std::same_as<typename Io::Number, Ranges> Ranges horizon_tangent(
    const Io& io, const RangeMask& active, const vec2<Ranges>& uv, const vec2<Ranges>& direction) {
    using namespace range_detail;
    const SampledTexture& map = *io.template texture<TextureSlot::horizon>();
    const std::int32_t azimuths = map.view.faces;
    Ranges result(Ranged::anything());
    for (int i = 0; i < 4; ++i) {
        if (active.lane[i].known().state == RangeTruth::no) continue;
        const RealInterval turn = turn_range(direction.x.lane[i], direction.y.lane[i]);
        const RealInterval at(turn.lo * azimuths, turn.hi * azimuths);
        const auto tangent = [&](double k) {
            const double from_first = k - azimuths * std::floor(k / azimuths);
            const auto azimuth = static_cast<std::int32_t>(from_first);
            return layers_range(map, {azimuth, azimuth}, false, uv.x.lane[i], uv.y.lane[i]);
        };
        TexelRange range = TexelRange::nothing();
        for (double below = std::floor(at.lo); below <= at.hi; ++below)
            range.include(blended(tangent(below), tangent(below + 1), weights_in(at, below)));
        const RealInterval all = range.channel[0];
        const double unit = budget().unit > 0 ? budget().unit : 0x1p-48;
        result.lane[i] = Ranged(widened(all, 4 * unit * all.magnitude()));
    }
    return result;
}

}  // namespace quadrel
