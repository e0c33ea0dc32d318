// The level of detail of the undisplaced UV, which searches and most look-ups at a hit filter with.
// Its logarithm takes longer than a bilinear fetch, and is the same for all textures of one size:
// where a batch has a place for it (StageCall::scales), the first stage that needs it leaves it
// there.
#pragma once

#include <algorithm>
#include <concepts>

#include "quadrel/quad/stage.hpp"

namespace quadrel {

/// Of each quad of a batch, the scale factors of the textures of one size and form.
struct SharedScales {
    std::uint64_t keys[batch_quads];  ///< scale_key of a texture; 0: none yet
    alignas(64) float rho[batch_lanes], log2_rho[batch_lanes];
};

/// Equal where the same gradients have the same scale factor; never 0.
inline std::uint64_t scale_key(const SampledTexture& texture) {
    return std::uint64_t(texture.view.width[0]) | std::uint64_t(texture.view.height[0]) << 28 |
           static_cast<std::uint64_t>(texture.sampler.lod_form) << 56;
}

/// The scale factor of the undisplaced UV. The stage loads dUVdx and dUVdy.
template <class Io, class F = typename Io::Number>
ScaleFactor<F> undisplaced_scale(const Io& io, const SampledTexture& map) {
    const auto compute = [&] {
        return scale_factor_of(map, io.template load<Value::dUVdx>(),
                               io.template load<Value::dUVdy>());
    };
    if constexpr (std::same_as<Scalar<F>, float>) {
        if (SharedScales* const shared = io.call().scales) {
            const std::uint64_t key = scale_key(map);
            float* const rho = shared->rho + io.first_lane();
            float* const log2_rho = shared->log2_rho + io.first_lane();
            std::uint64_t* const keys = shared->keys + io.first_lane() / 4;
            // Packets of other widths may have been there: every quad is asked.
            constexpr int quads = lanes_of<F> / 4;
            if (std::count(keys, keys + quads, key) == quads)
                return {load<F>(rho), load<F>(log2_rho)};
            const ScaleFactor<F> scale = compute();
            store(rho, scale.rho);
            store(log2_rho, scale.log2_rho);
            std::fill_n(keys, quads, key);
            return scale;
        }
    }
    return compute();
}

/// What the records of a stage's look-ups are for.
template <class Io>
LodUse lod_use_of(const Io& io) {
    return io.call().log != nullptr ? LodUse::shown : LodUse::look_up;
}

/// lod_for the undisplaced UV's gradients. The stage loads dUVdx and dUVdy.
template <class Io, class F = typename Io::Number>
LodRecord<F> undisplaced_lod(const Io& io, const SampledTexture& map, LodUse use) {
    if (use == LodUse::look_up) {
        if (!lod_matters(map)) return finest_lod<F>();
        const Gradients<F> texels = texel_gradients<F>(
            map, {io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>()});
        if (all_magnified(map, texels, total_bias(map, F(0)))) return finest_lod<F>();
    }
    return lod_of_scale(map, undisplaced_scale(io, map));
}
/// For the stage's own look-ups.
template <class Io, class F = typename Io::Number>
LodRecord<F> undisplaced_lod(const Io& io, const SampledTexture& map) {
    return undisplaced_lod(io, map, lod_use_of(io));
}

}  // namespace quadrel
