// Look-ups in tables of distances on ranges: the least and the greatest that is interpolated
// anywhere in ranges of place, layer and direction.
//
// What is linear along each of five dimensions has its extremes over a box at the box's corners, so
// that a box is cut along the nodes that it crosses, and the corners of each part are looked at.
#pragma once

#include "quadrel/num/range/geometry.hpp"
#include "quadrel/relief/trace/table/gdm.hpp"
#include "quadrel/texture/range/map_range.hpp"

namespace quadrel {

namespace range_detail {

/// A range of places along one dimension of a table, counted in nodes.
struct TableSpan {
    double low = 0, high = 0;
    std::int32_t count = 1;  ///< nodes
    bool repeats = false;

    static TableSpan clamped(const Ranged& at, std::int32_t count) {
        const double last = count - 1;
        if (!at.is_bounded()) return {0, last, count, false};
        const RealInterval x = at.range();
        return {std::clamp(x.lo, 0.0, last), std::clamp(x.hi, 0.0, last), count, false};
    }
    static TableSpan of_coordinate(const Ranged& u, std::int32_t texels, const GridAxis& axis,
                                   std::int32_t blocks) {
        const Ranged at = (u * Ranged(double(texels)) - Ranged(double(axis.first))) *
                              Ranged(double(blocks) / axis.count) -
                          Ranged(0.5);
        if (!axis.periodic) return clamped(at, blocks);
        if (!at.is_bounded() || at.range().width() >= blocks)
            return {0, double(blocks), blocks, true};
        return {at.range().lo, at.range().hi, blocks, true};
    }

    double first() const { return std::floor(low); }
    double last() const { return std::floor(high); }
    double parts() const { return last() - first() + 1; }
    /// The nodes on either side of the part that begins at node `k`.
    std::int32_t node(double k, int side) const {
        const double at = k + side;
        if (repeats) return static_cast<std::int32_t>(at - count * std::floor(at / count));
        return static_cast<std::int32_t>(std::min(at, double(count - 1)));
    }
    /// How far from node `k` the range begins in that part, or ends there.
    double weight(double k, int end) const {
        return end == 0 ? std::max(low, k) - k : std::min(high, k + 1) - k;
    }
};

/// The box that a look-up may be anywhere in: columns, rows, layers, and both coordinates of
/// directions.
using TableBox = std::array<TableSpan, 5>;

/// `node(indices)` is what the table holds.
template <class Node>
RealInterval table_range(const TableBox& box, const Node& node) {
    constexpr int dimensions = 5, corners = 1 << dimensions;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    RealInterval range(infinity, -infinity);
    double at[dimensions];
    for (int d = 0; d < dimensions; ++d) at[d] = box[static_cast<std::size_t>(d)].first();
    for (bool more = true; more;) {
        double value[corners];
        for (int corner = 0; corner < corners; ++corner) {
            std::int32_t index[dimensions];
            for (int d = 0; d < dimensions; ++d)
                index[d] = box[static_cast<std::size_t>(d)].node(at[d], corner >> d & 1);
            value[corner] = node(index);
            if (!std::isfinite(value[corner])) return {-infinity, infinity};
        }
        for (int d = 0; d < dimensions; ++d)
            for (int corner = 0; corner < corners; ++corner) {
                const int other = corner | 1 << d;
                if (corner == other) continue;
                const double low = value[corner], step = value[other] - low;
                const TableSpan& span = box[static_cast<std::size_t>(d)];
                value[corner] = low + span.weight(at[d], 0) * step;
                value[other] = low + span.weight(at[d], 1) * step;
            }
        for (const double x : value) range = hull(range, x);
        more = false;
        for (int d = 0; d < dimensions && !more; ++d) {
            const TableSpan& span = box[static_cast<std::size_t>(d)];
            more = ++at[d] <= span.last();
            if (!more) at[d] = span.first();
        }
    }
    return range;
}

}  // namespace range_detail

template <TextureSlot slot, class Io>
requires std::same_as<typename Io::Number, Ranges>
class DistanceTable<slot, Io> {
  public:
    using F = Ranges;
    static constexpr int fetches = 8;

    DistanceTable(const Io& io, const vec2<F>& K)
        : map_(io.template texture<TextureSlot::height>()->view),
          table_(io.template texture<slot>()->view),
          texture_(*io.template texture<slot>()),
          grid_(texel_grid(map_.width[0], map_.height[0],
                           io.template texture<TextureSlot::height>()->sampler)) {
        const vec2<F> at = square_of_direction(K / table_.depth());
        const F half(static_cast<double>(table_.directions() - 1) / 2);
        direction_ = {(at.x + F(1)) * half, (at.y + F(1)) * half};
    }

    const DirectionTable<F>& table() const { return table_; }

    F fall(RangeMask active, const vec2<F>& uv, F layer) const {
        F result(Ranged::anything());
        for (int i = 0; i < 4; ++i)
            if (active.lane[i].known().state != RangeTruth::no)
                result.lane[i] = of_lane(uv.x.lane[i], uv.y.lane[i], layer.lane[i], i);
        return result;
    }

  private:
    /// Boxes that cross more parts than this are all of the table.
    static constexpr double most_parts = 512;
    /// Roundings of five interpolations, of the largest that is held.
    static constexpr double roundings = 24;

    Ranged of_lane(const Ranged& u, const Ranged& v, const Ranged& layer, int lane) const {
        using namespace range_detail;
        TableBox box{TableSpan::of_coordinate(u, map_.width[0], grid_.u, table_.columns()),
                     TableSpan::of_coordinate(v, map_.height[0], grid_.v, table_.rows()),
                     TableSpan::clamped(layer, table_.slices()),
                     TableSpan::clamped(direction_.x.lane[lane], table_.directions()),
                     TableSpan::clamped(direction_.y.lane[lane], table_.directions())};
        double parts = 1;
        for (const TableSpan& span : box) parts *= span.parts();
        const RealInterval range =
            parts <= most_parts ? table_range(box,
                                              [&](const std::int32_t(&k)[5]) {
                                                  return double{held(k[0], k[1], k[2], k[3], k[4])};
                                              })
                                : whole_map(texture_).channel[0];
        const double unit = budget().unit > 0 ? budget().unit : 0x1p-48;
        return number(widened(range, roundings * unit * range.magnitude()));
    }

    float held(std::int32_t i, std::int32_t j, std::int32_t k, std::int32_t a,
               std::int32_t b) const {
        const TextureView& view = texture_.view;
        const std::int64_t row =
            std::int64_t{k} * view.height[0] + std::int64_t{b} * table_.rows() + j;
        return view.texels[row * view.width[0] + std::int64_t{a} * table_.columns() + i];
    }

    const TextureView& map_;
    DirectionTable<F> table_;
    const SampledTexture& texture_;
    Grid grid_;
    vec2<F> direction_;
};

/// Of a rate that may be 0, no later than ever: beyond s = 1 all exits are the same.
template <>
inline Ranges PrismAxis<Ranges>::exit() const {
    constexpr double ever = 1e6;
    const Ranges ahead = select(rate > Ranges(0), box + Ranges(1), box);
    Ranges result = (ahead - start) / rate;
    for (int lane = 0; lane < 4; ++lane) {
        if (!rate.lane[lane].is_bounded() || !start.lane[lane].is_bounded()) continue;
        const RealInterval speed = rate.lane[lane].range();
        if (!speed.has_zero()) continue;
        const RealInterval at = start.lane[lane].range(), here = box.lane[lane].range();
        double least = ever;
        if (speed.hi > 0) least = std::min(least, (here.lo + 1 - at.hi) / speed.hi);
        if (speed.lo < 0) least = std::min(least, (here.hi - at.lo) / speed.lo);
        const double rounded_down = least - (std::fabs(least) + 1) * 0x1p-20;
        result.lane[lane] = Ranged(std::max(rounded_down, 0.0), ever);
    }
    return result;
}

}  // namespace quadrel
