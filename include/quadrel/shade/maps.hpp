// Reading a material's colour maps, with what an absent map stands for.
#pragma once

#include "quadrel/relief/view.hpp"
#include "quadrel/texture/cube.hpp"

namespace quadrel {

/// The map at the displaced UV, filtered with the gradients of the undisplaced one; `absent` where
/// no map is bound.
template <TextureSlot slot, class Io, class F = typename Io::Number>
vec4<F> map_at_hit(Io& io, const vec4<F>& absent) {
    const SampledTexture* map = io.template texture<slot>();
    if (!map) return absent;
    return texture_grad(*map, io.template context<slot>(), io.template load<Value::hit_uv>(),
                        io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>());
}

template <Number F>
vec3<F> rgb(const vec4<F>& v) {
    return {v.x, v.y, v.z};
}

}  // namespace quadrel
