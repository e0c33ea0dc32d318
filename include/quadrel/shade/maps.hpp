// Reading a material's colour maps, with what an absent map stands for.
#pragma once

#include "quadrel/relief/map_gradients.hpp"
#include "quadrel/relief/view.hpp"
#include "quadrel/texture/cube.hpp"

namespace quadrel {

/// The map at the displaced UV, filtered with the footprint that `gradients` says
/// (map_gradients.hpp); `absent` where no map is bound.
template <TextureSlot slot, class Io, class F = typename Io::Number>
vec4<F> map_at_hit(Io& io, const vec4<F>& absent, std::int32_t gradients = 0) {
    const SampledTexture* map = io.template texture<slot>();
    if (!map) return absent;
    return texel_at<slot>(io, *map, io.template load<Value::hit_uv>(), gradients);
}

/// The same as listings have it, with the implicit derivatives of the displaced UV.
template <TextureSlot slot, class Io, class F = typename Io::Number>
vec4<F> listed_map_at_hit(Io& io, const vec4<F>& absent) {
    const SampledTexture* map = io.template texture<slot>();
    if (!map) return absent;
    return implicit_texel<slot>(io, *map, io.template load<Value::hit_uv>());
}

template <Number F>
vec3<F> rgb(const vec4<F>& v) {
    return {v.x, v.y, v.z};
}

}  // namespace quadrel
