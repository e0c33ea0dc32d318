// Reading cone maps, and the step that a cone allows.
//
// A cone of ratio c stands, tip down, on the surface below a point of the ray whose gap to the
// surface is g: its radius at height z over the tip is c z, in tiles. A ray that falls by ds moves
// by |K| ds sideways, so it leaves the cone at ds = c g / (c + |K|).
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Fall in s that a cone allows; the whole gap straight down, 0 where the cone has no width.
template <Number F>
F cone_step_length(F gap, F ratio, F kappa) {
    const F step = ratio * gap / (ratio + kappa);
    return select(kappa > F(0), step, gap);
}

/// What the look-up of a cone map interpolates: its ratios, or their square roots, which sources of
/// 8-bit maps store.
enum class Interpolated { ratios, roots };

/// Bilinear look-ups of `channels` channels of a baked map's level 0 by the sampler's wrap modes.
/// With roots the second channel is interpolated by its root, and squared again.
template <TextureSlot slot, int channels, class Io, Interpolated what = Interpolated::ratios>
class BakedLookUp {
  public:
    using F = typename Io::Number;

    explicit BakedLookUp(const Io& io)
        : io_(io), map_(*io.template texture<slot>()), level_(level_geometry<F>(map_.view, 0)) {}

    Texel<channels, F> operator()(Mask<F> active, const vec2<F>& uv) const {
        return fetch(active, uv, level_);
    }
    /// In a layer of the map's, one per lane.
    Texel<channels, F> operator()(Mask<F> active, const vec2<F>& uv, Int<F> layer) const {
        LevelGeometry<F> level = level_;
        level.offset = level.offset + layer * (level.width * level.height * Int<F>(channels));
        return fetch(active, uv, level);
    }

    /// The size of the map, in texels.
    vec2<F> size() const { return {level_.width_number, level_.height_number}; }

  private:
    /// One fetch in the lanes of `active`. Out of line: a search has one copy.
    [[gnu::noinline]] Texel<channels, F> fetch(Mask<F> active, const vec2<F>& uv,
                                               const LevelGeometry<F>& level) const {
        const SampleContext<F> context = io_.template context<slot>(active);
        count_fetch(context);
        count_coordinate(context, uv.x, F(coordinate_limit));
        count_coordinate(context, uv.y, F(coordinate_limit));
        if (const TexelMarks* marks = marks_of(context))
            mark_footprint<F>(*marks, map_, level, uv, Filter::linear, active);
        if constexpr (what == Interpolated::ratios)
            return sample_linear<channels, F>(map_, level, uv);
        const Footprint<F> at = address(map_, level, uv, Filter::linear);
        FourTaps<channels, F> taps = load_taps<channels, F>(map_, level, at);
        for (auto& tap : taps.tap) tap.channel[1] = sqrt(tap.channel[1]);
        Texel<channels, F> texel = blend(taps, at.x.weight, at.y.weight);
        texel.channel[1] = texel.channel[1] * texel.channel[1];
        return texel;
    }

    const Io& io_;
    const SampledTexture& map_;
    LevelGeometry<F> level_;
};

/// Height and cone ratio of a cone map in one look-up.
template <Number F>
struct Cone {
    F height, ratio;
};

template <TextureSlot slot, Interpolated what = Interpolated::ratios, class Io,
          class F = typename Io::Number>
auto cone_look_up(const Io& io) {
    return
        [&io, read = BakedLookUp<slot, 2, Io, what>(io)](Mask<F> active, F s, const vec2<F>& uv) {
            const Texel<2, F> texel = read(active, uv);
            io.march_step(active, s, uv, F(1) - s, texel.channel[0]);
            return Cone<F>{texel.channel[0], texel.channel[1]};
        };
}

/// Fall in s to the nearest border between texel centres, where the bilinear patch changes, and a
/// little more. Infinite for a ray straight down.
template <Number F>
F fall_to_cell_border(const vec2<F>& uv, const vec2<F>& K, const vec2<F>& size) {
    const F beyond(1e-5f);
    const auto axis = [&](F u, F rate, F texels) {
        const F x = u * texels - F(0.5f), speed = rate * texels;
        const F next = select(speed > F(0), floor(x) + F(1), ceil(x) - F(1));
        const F fall = (next - x) / speed;
        return select(speed == F(0), F(std::numeric_limits<Scalar<F>>::infinity()), fall);
    };
    return max(min(axis(uv.x, K.x, size.x), axis(uv.y, K.y, size.y)), F(0)) + beyond;
}

}  // namespace quadrel
