// cone-step: steps as long as the cone below the ray allows.
//
// Source: J. Dummer, "Cone Step Mapping: An Iterative Ray-Heightfield Intersection Algorithm",
// 2006. Corrects its listings: the number of steps is a parameter, the search ends within
// `tolerance` of the surface (cones alone come near to it and never arrive) and says CAP where it
// did not, a straight ray falls the whole gap, and a step never ends below the bottom plane. Never
// early by more than the tolerance. Late where a bilinear surface pierces the cones that stand on
// texel centres, or a wide cone is interpolated into the neighbourhood of a narrow one.
#pragma once

#include "quadrel/relief/trace/cone/cone_walk.hpp"

namespace quadrel {

/// Parameters of the corrected cone searches.
struct ConeParams {
    std::int32_t steps = 128;
    float tolerance = 1.0f / 1024;
};
inline constexpr std::array cone_parameters{
    parameter<&ConeParams::steps>("steps", "1", "points of the ray that may be tested", 1, 65536,
                                  128),
    parameter<&ConeParams::tolerance>("tolerance", "depth",
                                      "gap to the surface that counts as a hit", 0, 1, 1.0 / 1024)};

/// A search that takes those parameters.
struct ConeSearch : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    using Params = ConeParams;
    static constexpr auto parameters = cone_parameters;
};

/// Walks along the cones of `look`, which takes `look_ups` a point, and stores the outcome.
template <class Io, class Look, class F = typename Io::Number>
void store_cone_steps(const Io& io, const SearchRay<F>& ray, const Look& look,
                      const ConeParams& params, std::int32_t look_ups) {
    auto walk = walk_cones<F>(ray, look, fall_by_cone(ray), params.steps, F(params.tolerance));
    walk.result.fetches = walk.result.fetches * Int<F>(look_ups);
    store_search(io, ray, walk.result);
}

struct ConeStep : ConeSearch {
    static constexpr StageText text{"cone-step", "trace", "steps as long as cones allow",
                                    "Dummer 2006, Cone Step Mapping"};
    static constexpr auto textures = slots(TextureSlot::cone);

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        const auto ray = search_ray(io);
        store_cone_steps(io, ray, cone_look_up<TextureSlot::cone>(io), params, 1);
    }
};

}  // namespace quadrel
