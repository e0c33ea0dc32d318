// steep-mip-c and steep-mip-i: linear search in a mip level that the steps cannot jump over.
//
// Source: McGuire and McGuire 2005, who use the mip level to sample above the Nyquist rate; there
// is no listing. A step of |K| / n must be at most half a texel of the level, so
//     l = max(0, log2(2 max(|K.u| width, |K.v| height) / n)),
// as it is (-c, blended between levels where the sampler's mip filter is linear) or rounded up
// (-i). The sampler's bias and clamps apply; without mip levels both are `linear`.
// Every feature of the filtered map is seen, but averaging lowers what is thin: against level 0
// hits are late, early or lost. No crossing: FLOOR.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// The finest level of which n steps along K sample every texel twice.
template <Number F>
F nyquist_level(const SampledTexture& map, const vec2<F>& K, int n) {
    const F texels = texels_crossed(map, K) / F(static_cast<Scalar<F>>(n));
    return log2(max(texels * F(2), F(1)));
}

template <bool whole>
struct SteepMip : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text =
        whole ? StageText{"steep-mip-i", "trace", "linear search in the mip level of its steps",
                          "McGuire and McGuire 2005, text"}
              : StageText{"steep-mip-c", "trace",
                          "linear search in the mip level of its steps, blended",
                          "McGuire and McGuire 2005, text"};
    static constexpr auto inputs = search_inputs;
    static constexpr bool needs_height_map = true;
    struct Params {
        std::int32_t steps = 32;
    };
    static constexpr std::array parameters{parameter<&Params::steps>(
        "steps", "1", "steps over the relief's depth", 1, most_steps, 32)};
    static std::int32_t lattice_steps(const Params& params) { return params.steps; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const F level = nyquist_level(map, ray.K, params.steps);
        const auto heights = march_heights_of_level(io, whole ? ceil(level) : level);
        const F n(static_cast<Scalar<F>>(params.steps));
        store_search(io, ray,
                     result_of(first_bracket(tested_heights(io, heights), ray, n, params.steps,
                                             Before::not_needed)));
    }
};

using SteepMipC = SteepMip<false>;
using SteepMipI = SteepMip<true>;

}  // namespace quadrel
