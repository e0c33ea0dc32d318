// Look-ups in a warped relief texture on ranges. What is found is a mean of the taps that have
// anything: no less than the least of them, no more than the greatest.
#pragma once

#include "quadrel/relief/trace/search/range_parts.hpp"
#include "quadrel/relief/trace/table/prewarp.hpp"
#include "quadrel/texture/range/map_range.hpp"

namespace quadrel {

namespace range_detail {

/// u, v and s, and how much of a look-up's weight has anything.
struct WarpedRange {
    RealInterval found[3];
    RealInterval weight;
};

/// The warped image's texels, without its last row.
class WarpedTexels {
  public:
    explicit WarpedTexels(const TextureView& view) : view_(view) {}

    std::int32_t width() const { return view_.width[0]; }
    std::int32_t height() const { return view_.height[0] - 1; }
    TexelValue at(double i, double j) const {
        const auto x = static_cast<std::int64_t>(std::clamp(i, 0.0, double(width() - 1)));
        const auto y = static_cast<std::int64_t>(std::clamp(j, 0.0, double(height() - 1)));
        TexelValue value;
        for (int c = 0; c < 4; ++c) value.channel[c] = row(y)[4 * x + c];
        return value;
    }
    /// The rectangle of texture space that the image covers: its least u and v, and one over sides.
    const float* area() const { return row(height()); }

  private:
    const float* row(std::int64_t y) const {
        return view_.texels + view_.offset[0] + 4 * y * view_.width[0];
    }
    const TextureView& view_;
};

/// Over ranges of places in texels, centres at whole numbers; false where they are too many.
inline bool warped_range(WarpedRange& range, const WarpedTexels& texels, const RealInterval& x,
                         const RealInterval& y) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const RealInterval columns(std::floor(x.lo), std::floor(x.hi));
    const RealInterval rows(std::floor(y.lo), std::floor(y.hi));
    if (!((columns.width() + 1) * (rows.width() + 1) <= most_texels)) return false;
    for (RealInterval& channel : range.found) channel = {infinity, -infinity};
    range.weight = {infinity, -infinity};
    for (double j = rows.lo; j <= rows.hi; ++j)
        for (double i = columns.lo; i <= columns.hi; ++i) {
            const RealInterval f = weights_in(x, i), g = weights_in(y, j);
            TexelRange patch = TexelRange::nothing();
            include_patch(patch, texels, i, j, f, g);
            range.weight = hull(range.weight, patch.channel[3]);
            TexelRange taps = TexelRange::nothing();
            bool whole = true;
            for (int tap = 0; tap < 4; ++tap) {
                const TexelValue texel = texels.at(i + tap % 2, j + tap / 2);
                whole &= texel.channel[3] == 1;
                if (texel.channel[3] > 0) taps.include(texel.channel);
            }
            for (int c = 0; c < 3; ++c)
                range.found[c] = hull(range.found[c], (whole ? patch : taps).channel[c]);
        }
    for (const RealInterval& channel : range.found)
        if (range.weight.hi > 0 && !std::isfinite(channel.width())) return false;
    return true;
}

}  // namespace range_detail

struct ReliefPrewarpOnRanges : ReliefPrewarp {
    template <class Io>
    void operator()(Io& io, const Params&) const {
        using namespace range_detail;
        const SearchRay<Ranges> ray = search_ray(io);
        const WarpedTexels texels(io.template texture<TextureSlot::prewarp>()->view);
        SearchResult<Ranges> result;
        vec2<Ranges> uv = ray.uv;
        for (int lane = 0; lane < 4; ++lane) {
            if (ray.active.lane[lane].known().state == RangeTruth::no) continue;
            result.s.lane[lane] = Ranged(0.0, 1.0);
            result.status.lane[lane] = any_status();
            uv.x.lane[lane] = uv.y.lane[lane] = Ranged::anything();
            const auto place = [&](const Ranged& u, int axis, std::int32_t count) -> Ranged {
                const float* const area = texels.area();
                const Ranged at = (u - Ranged(double{area[axis]})) *
                                      Ranged(double{area[2 + axis]}) * Ranged(double(count)) -
                                  Ranged(0.5);
                return min(max(at, Ranged(0.0, 0.0)), Ranged(count - 1.0, count - 1.0));
            };
            const Ranged x = place(ray.uv.x.lane[lane], 0, texels.width());
            const Ranged y = place(ray.uv.y.lane[lane], 1, texels.height());
            WarpedRange range;
            if (!x.is_bounded() || !y.is_bounded() ||
                !warped_range(range, texels, x.range(), y.range()))
                continue;
            take(range, lane, ray, result, uv);
        }
        result.h = Ranges(1) - result.s;
        result.flags = any_flags();
        result.steps = result.fetches = any_count();
        store_search(io, ray, result, uv);
    }

  private:
    /// There is something where half of the weight has anything.
    static void take(const range_detail::WarpedRange& range, int lane, const SearchRay<Ranges>& ray,
                     SearchResult<Ranges>& result, vec2<Ranges>& uv) {
        using namespace range_detail;
        const double off = 16 * (budget().unit > 0 ? budget().unit : 0x1p-48);
        const bool may_hit = range.weight.hi >= 0.5 - off, may_miss = range.weight.lo < 0.5 + off;
        const int ends = (may_hit ? 1 : 0) + (may_miss ? 1 : 0);
        const int which = ends == 1 ? (may_hit ? 0 : 1) : one_of_parts(ends, lane);
        const auto mean = [&](int c) {
            return Ranged(widened(range.found[c], off * range.found[c].magnitude()));
        };
        const Ranged here(ray.s_polygon);
        result.status.lane[lane] = statuses(which == 1 ? Status::clip : Status::hit,
                                            which == 0 ? Status::hit : Status::clip);
        const auto either = [&](const Ranged& hit, const Ranged& miss) {
            return which == 0 ? hit : which == 1 ? miss : join(hit, miss);
        };
        if (which == 1) {
            result.s.lane[lane] = here;
            uv.x.lane[lane] = ray.uv.x.lane[lane];
            uv.y.lane[lane] = ray.uv.y.lane[lane];
            return;
        }
        const Ranged s = min(max(mean(2), Ranged(0.0, 0.0)), Ranged(1.0, 1.0));
        result.s.lane[lane] = either(s, here);
        uv.x.lane[lane] = either(mean(0), ray.uv.x.lane[lane]);
        uv.y.lane[lane] = either(mean(1), ray.uv.y.lane[lane]);
    }
};

}  // namespace quadrel
