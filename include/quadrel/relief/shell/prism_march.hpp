// A march along a ray through a piece of a shell, in even steps, to the last sample above the
// surface and the first at or below it, and the chord between both.
#pragma once

#include "quadrel/relief/shell/prism_ray.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tested_heights.hpp"

namespace quadrel {

/// A PrismTrace in steps, whose look-ups have gradients.
struct PrismMarchTrace : PrismTrace {
    static constexpr auto inputs = values_and(PrismTrace::inputs, Value::dUVdx, Value::dUVdy);
    static constexpr auto textures = slots(TextureSlot::height);
};

template <class Io>
class PrismMarch {
  public:
    using F = typename Io::Number;

    PrismMarch(const Io& io, const PrismRay<F>& ray)
        : io_(io), ray_(ray), heights_(march_heights(io)) {}

    /// Steps are as long in all pieces: 1 / `density` of the shell's depth, at most `most`. A piece
    /// has one at least; where it begins is tested, too, and so is where it ends.
    void march(int density, int most) {
        const F wanted = ceil(ray_.length / ray_.uv.depth * number<F>(density));
        // Of depth 0, NaN: one.
        const F n = select(wanted >= F(1), min(wanted, number<F>(most)), F(1));
        Mask<F> active = ray_.uv.active;
        for (const auto k : steps<F>(0, most)) {
            const F index = number<F>(k);
            active = active & (index <= n);
            if (none(active)) break;
            const Mask<F> below =
                test(active, min(index / n, F(1)), ray_.ends_below & (index == n));
            found_ = found_ | below;
            active = active & !below;
        }
    }

    /// Halves what is between both samples.
    void halve(int times) {
        const Mask<F> active = found_ & (t_below_ > F(0));
        for (const auto k : steps<F>(1, times)) {
            if (none(active)) break;
            test(active, (t_above_ + t_below_) * F(0.5f), Mask<F>(false));
        }
    }

    /// Where the chord of both heights meets the ray. Rays without a hit are CLIP.
    void store() {
        const F sum = gap_ + excess_;
        const F part = select((sum > F(0)) & (t_below_ > F(0)), gap_ / sum, F(1));
        const F t = min(t_above_ + (t_below_ - t_above_) * part, t_below_);
        result_.s = select(found_, t, F(1));
        result_.h = select(found_ & (t_below_ > F(0)), ray_.height_at(t), height_);
        result_.fetches = result_.steps;
        result_.status = search_status<F>(found_, met_nan_, Status::clip);
        store_prism(io_, ray_, result_);
    }

  private:
    /// Whether the surface is at or above the ray at t, or `ends` there.
    Mask<F> test(Mask<F> active, F t, Mask<F> ends) {
        const F z = ray_.height_at(t);
        const vec2<F> uv = ray_.uv.at(t);
        const F h = heights_(active, uv);
        io_.march_step(active, ray_.s_at(t), uv, z, h);
        count_in<F>(result_.steps, active);
        const Mask<F> below = active & ((h >= z) | (ends & !is_nan(h))), above = active & !below;
        t_below_ = select(below, t, t_below_);
        excess_ = select(below, max(h - z, F(0)), excess_);
        height_ = select(active, h, height_);
        t_above_ = select(above, t, t_above_);
        gap_ = select(above, z - h, gap_);
        met_nan_ = met_nan_ | (active & is_nan(h));
        return below;
    }

    const Io& io_;
    PrismRay<F> ray_;
    MarchHeights<Io> heights_;
    F t_above_ = F(0), t_below_ = F(0), gap_ = F(0), excess_ = F(0), height_ = F(0);
    Mask<F> found_ = Mask<F>(false), met_nan_ = Mask<F>(false);
    SearchResult<F> result_;
};

}  // namespace quadrel
