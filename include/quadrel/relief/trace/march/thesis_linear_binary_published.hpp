// thesis-linear-binary@published: "a linear per-pixel search over the uninterpolated height map,
// followed by a binary search over the interpolated values of the last two texels".
//
// Source: "Derivative-Based Relief Mapping" (2012), section on searches; it has no listing. Taken
// literally: the ray is sampled once a texel with the nearest texel's height (level 0), the first
// sample strictly below the surface ends that (as in the listed linear search), and the interval
// before it is halved `binary_steps` times with interpolated heights, whose test is strict too.
// Nothing makes the interpolated surface cross the ray in that interval: where it does not, the
// status is CAP, and the end of the interval that the halvings run to is returned. No sample below:
// the bottom plane, FLOOR.
#pragma once

#include "quadrel/relief/trace/march/thesis_linear_binary.hpp"

namespace quadrel {

struct ThesisLinearBinaryPublished : ThesisLinearBinarySearch {
    static constexpr StageText text{
        "thesis-linear-binary@published", "trace",
        "linear search over nearest texels, then bisection over interpolated ones",
        "Derivative-Based Relief Mapping (2012)"};
    static constexpr const char* not_reproduced = "there is no listing: the text, taken literally";

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const SampledTexture texels = level_0(map, Filter::nearest);
        const SampledTexture patches = level_0(map, Filter::linear);
        const LodRecord<F> finest = lod_from_level(texels, F(0));
        const MarchHeights<Io> nearest(io, texels, finest), linear(io, patches, finest);

        const F n = steps_by_texel(map, ray.K, params);
        const NearestHeights<Io> texel_heights(io, nearest);
        auto interval = search(texel_heights, ray, n, params.max_steps);
        const Mask<F> crosses =
            halve(tested_heights(io, linear), ray, params.binary_steps, interval);
        SearchResult<F> result = result_of(interval);
        const Mask<F> lost = interval.found & !interval.met_nan & !crosses;
        result.status = select(lost, status_packet<F>(Status::cap), result.status);
        store_search(io, ray, result);
    }

  private:
    /// Every texel is a corner of a cell around the point, and bounded with it. Between two points
    /// heights jump.
    template <class Io>
    struct NearestHeights : TestedHeights<Io, MarchHeights<Io>> {
        using TestedHeights<Io, MarchHeights<Io>>::TestedHeights;
        CeilingLevels ceiling(Mask<typename Io::Number> active) const {
            CeilingLevels levels = TestedHeights<Io, MarchHeights<Io>>::ceiling(active);
            levels.continuous = false;
            return levels;
        }
    };

    static SampledTexture level_0(SampledTexture map, Filter filter) {
        map.sampler.mag = map.sampler.min = filter;
        map.sampler.mip = MipFilter::none;
        return map;
    }

    template <class Height, class F>
    static Bracket<F> search(const Height& height, const SearchRay<F>& ray, F n, int last) {
        Bracket<F> interval;
        Mask<F> active = ray.active;
        for (const auto k : steps_near_surface<F>(height, ray, active, n, last, Before::needed)) {
            const F index = number<F>(k);
            active = active & (index < n + F(1)) & (index <= number<F>(last));
            if (none(active)) break;
            const F s = min(index / n, F(1));
            const F h = height(active, s, ray.at(s), F(1) - s);
            take(interval, active, s, h);
            interval.found = interval.found | (active & (h > F(1) - s));
            interval.h_below = select(active, h, interval.h_below);
            active = active & !(h > F(1) - s);
        }
        return interval;
    }

    /// Halves, and tests both ends first: whether the interpolated surface crosses the ray between.
    template <class Height, class F>
    static Mask<F> halve(const Height& height, const SearchRay<F>& ray, int times,
                         Bracket<F>& interval) {
        const auto excess = [&](F s) {
            const F h = height(interval.found, s, ray.at(s), F(1) - s);
            interval.met_nan = interval.met_nan | (interval.found & is_nan(h));
            count_in<F>(interval.steps, interval.found);
            return h - (F(1) - s);
        };
        const F before = excess(interval.s_above), behind = excess(interval.s_below);
        for (const auto k : steps<F>(1, times)) {
            const F s = (interval.s_above + interval.s_below) * F(0.5f);
            take(interval, interval.found, s, height(interval.found, s, ray.at(s), F(1) - s));
        }
        return (before <= F(0)) & (behind > F(0));
    }

    /// Bracket::narrow with the strict test.
    template <class F>
    static void take(Bracket<F>& interval, Mask<F> active, F s, F h) {
        const Mask<F> below = active & (h > F(1) - s), above = active & !below;
        interval.s_below = select(below, s, interval.s_below);
        interval.h_below = select(below, h, interval.h_below);
        interval.s_above = select(above, s, interval.s_above);
        interval.h_above = select(above, h, interval.h_above);
        interval.met_nan = interval.met_nan | (active & is_nan(h));
        count_in<F>(interval.steps, active);
    }
};

}  // namespace quadrel
