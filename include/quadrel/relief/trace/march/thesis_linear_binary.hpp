// thesis-linear-binary: one sample per texel, then bisection.
//
// Corrects thesis-linear-binary@published: heights are interpolated in both searches, so that the
// interval that the linear search hands over does hold a crossing. The samples divide the depth
// evenly, n = ceil of the texels that the ray crosses along the axis where it crosses most, at
// least `min_steps` and at most `max_steps`. One sample per texel is still not enough for the first
// crossing: a ray can enter and leave a bilinear patch between two samples. No crossing: FLOOR.
#pragma once

#include "quadrel/relief/trace/search/bracket.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ThesisLinearBinaryParams {
    std::int32_t binary_steps = 7, min_steps = 1, max_steps = 1024;
};

inline constexpr std::array thesis_linear_binary_parameters{
    parameter<&ThesisLinearBinaryParams::binary_steps>("binary_steps", "1",
                                                       "halvings of the last step", 0, 60, 7),
    parameter<&ThesisLinearBinaryParams::min_steps>("min_steps", "1", "least number of steps", 1,
                                                    most_steps, 1),
    parameter<&ThesisLinearBinaryParams::max_steps>("max_steps", "1", "greatest number of steps", 1,
                                                    most_steps, 1024)};

/// One step a texel of level 0.
template <Number F>
F steps_by_texel(const SampledTexture& map, const vec2<F>& K,
                 const ThesisLinearBinaryParams& params) {
    return clamp(ceil(texels_crossed(map, K)), F(static_cast<Scalar<F>>(params.min_steps)),
                 F(static_cast<Scalar<F>>(params.max_steps)));
}

/// What both rows have in common.
struct ThesisLinearBinarySearch : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs = search_inputs;
    static constexpr bool needs_height_map = true;
    using Params = ThesisLinearBinaryParams;
    static constexpr auto parameters = thesis_linear_binary_parameters;
    static std::int32_t lattice_steps(const Params& params) { return params.max_steps; }
};

struct ThesisLinearBinary : ThesisLinearBinarySearch {
    static constexpr StageText text{"thesis-linear-binary", "trace",
                                    "linear search by texels, then bisection",
                                    "correction of thesis-linear-binary@published"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        const auto height = tested_heights(io, heights);
        const F n = steps_by_texel(*io.template texture<TextureSlot::height>(), ray.K, params);
        auto bracket = first_bracket(height, ray, n, params.max_steps);
        bisect(height, ray, params.binary_steps, bracket);
        store_search(io, ray, result_of(bracket));
    }
};

}  // namespace quadrel
