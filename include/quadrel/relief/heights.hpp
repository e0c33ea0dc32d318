// The height field of a march: the material's height map, by the cheaper of two equal ways, or
// noise in its place.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrel/quad/shared_scales.hpp"
#include "quadrel/relief/noise.hpp"
#include "quadrel/relief/view.hpp"
#include "quadrel/texture/height_sampler.hpp"

namespace quadrel {

/// What the height map's look-ups can give.
template <class T>
struct HeightBounds {
    T low = -std::numeric_limits<T>::infinity(), high = std::numeric_limits<T>::infinity();
    bool flat() const { return low == high; }
};

/// The bounds that the material states; infinite where searches are to make every step.
template <class Io, class F = typename Io::Number>
HeightBounds<Scalar<F>> height_bounds(const Io& io) {
    const MaterialUniforms& material = io.material();
    if (material.heights_bounded == 0) return {};
    return {Scalar<F>(material.height_low), Scalar<F>(material.height_high)};
}

/// First k in [0, n] with h >= 1 - k / n, else n + 1, by the comparison that a march in n equal
/// steps makes.
template <class T>
int first_step_below(T h, int n) {
    const auto below = [&](int k) { return h >= 1 - static_cast<T>(k) / static_cast<T>(n); };
    const T count = static_cast<T>(n);
    // Off by rounding at most: the neighbours decide.
    int k = static_cast<int>(std::clamp(std::floor(count * (1 - h)), T(0), count));
    while (k > 0 && below(k - 1)) --k;
    while (k <= n && !below(k)) ++k;
    return k;
}

/// Whether the material's heights are noise: then it has no height map.
template <class Io>
bool heights_are_noise(const Io& io) {
    return io.material().noise_octaves > 0;
}

/// What level-of-detail arithmetic is given where heights are noise; never fetched from.
inline constexpr float no_texel = 0;
inline constexpr SampledTexture no_height_map{{&no_texel, 1, 1, 1, {1}, {1}, {0}}, {}};

/// Texels of level 0 along u and v, and the size of one in units of the texture.
template <Number F>
struct TexelSize {
    vec2<F> texels, step;

    explicit TexelSize(const SampledTexture& map)
        : texels(F(static_cast<Scalar<F>>(map.view.width[0])),
                 F(static_cast<Scalar<F>>(map.view.height[0]))),
          step(vec2<F>(F(1)) / texels) {}
};

/// The material's height map.
template <class Io>
const SampledTexture& height_map(const Io& io) {
    return heights_are_noise(io) ? no_height_map : *io.template texture<TextureSlot::height>();
}

/// A look-up where heights are noise.
template <class Io, class F>
[[gnu::noinline]] F noise_height(const Io& io, const SampleContext<F>& context, const vec2<F>& uv) {
    const MaterialUniforms& material = io.material();
    return noise_fetch(context, uv, material.noise_frequency, material.noise_octaves).value;
}

/// Heights at uv for a whole march, its level of detail settled beforehand. The short way is taken
/// when every lane reads one level, bilinearly, of a map of one channel; it has the same bits.
template <class Io>
class MarchHeights {
  public:
    using F = typename Io::Number;

    MarchHeights(const Io& io, const SampledTexture& map, const LodRecord<F>& lod)
        : io_(io), general_(map, lod), fast_(map, general_.levels()) {
        short_way_ = io.call().log == nullptr && FastHeight<F>::applies(map, general_.levels());
        noise_ = heights_are_noise(io);
    }

    /// `active`: the lanes that ask. One fetch each.
    F operator()(Mask<F> active, const vec2<F>& uv) const {
        const SampleContext<F> context = io_.template context<TextureSlot::height>(active);
        if (noise_) return noise(context, uv);
        return short_way_ ? fast_(context, uv) : long_way(context, uv);
    }

    const LodRecord<F>& lod() const { return general_.lod(); }

  private:
    /// Out of line: one copy of all filters and formats in a row, however often it fetches.
    [[gnu::noinline]] F long_way(const SampleContext<F>& context, const vec2<F>& uv) const {
        return general_(context, uv);
    }
    [[gnu::noinline]] F noise(const SampleContext<F>& context, const vec2<F>& uv) const {
        return noise_height(io_, context, uv);
    }

    const Io& io_;
    GeneralHeight<F> general_;
    FastHeight<F> fast_;
    bool short_way_, noise_;
};

/// Heights with the gradients of the undisplaced UV (textureGrad): what marches read unless their
/// source says otherwise. The stage loads dUVdx and dUVdy.
template <class Io>
MarchHeights<Io> march_heights(const Io& io) {
    const SampledTexture& map = height_map(io);
    return {io, map, undisplaced_lod(io, map)};
}

/// Heights of a level of detail a lane, 0 the finest; the sampler's bias and clamps apply
/// (textureLod).
template <class Io, class F = typename Io::Number>
MarchHeights<Io> march_heights_of_level(const Io& io, F level) {
    const SampledTexture& map = height_map(io);
    return {io, map, lod_from_level(map, level)};
}

}  // namespace quadrel
