// The footprint with which maps are filtered at the hit.
//
// texture(map, hit_uv) in a fragment shader takes implicit derivatives: the differences of the
// displaced coordinate over the quad. Where the relief hides a part of itself that coordinate
// jumps, and a line of fragments along each such edge is filtered from a level far too coarse.
// textureGrad with the differences of the undisplaced coordinate has no seams, and a footprint that
// is off where the surface tilts. Shaders of users do either. Rows with a parameter `gradients`
// take the second unless told otherwise, as searches do: neighbours' hits cannot change a fragment.
// Published rows do what their listing does.
#pragma once

#include "quadrel/quad/shared_scales.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

/// Parameters of a stage that has no others.
struct MapParams {
    std::int32_t gradients = 0;
};

inline constexpr ValueName gradients_names[] = {{0, "undisplaced"}, {1, "displaced"}};

template <auto member>
constexpr ParameterText gradients_parameter() {
    return choice<member>("gradients", "the UV whose footprint maps are filtered with",
                          gradients_names, 0);
}

inline constexpr std::array map_parameters{gradients_parameter<&MapParams::gradients>()};

/// texture(map, uv): the differences of `uv` itself. All four lanes of a quad must have one.
template <TextureSlot slot, class Io, class F = typename Io::Number>
vec4<F> implicit_texel(const Io& io, const SampledTexture& map, const vec2<F>& uv) {
    return texture(map, io.template context<slot>(), uv, io.frame().derivatives);
}

/// The map at `uv` with the footprint that `gradients` says. The stage loads dUVdx and dUVdy.
template <TextureSlot slot, class Io, class F = typename Io::Number>
vec4<F> texel_at(const Io& io, const SampledTexture& map, const vec2<F>& uv,
                 std::int32_t gradients) {
    if (gradients != 0) return implicit_texel<slot>(io, map, uv);
    return sample_expanded(map, io.template context<slot>(), uv, undisplaced_lod(io, map));
}

}  // namespace quadrel
