// Heights as texture() gives them, without gradients of one's own.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// A look-up of the height map with implicit derivatives; all lanes need a coordinate.
template <class Io, class F = typename Io::Number>
F implicit_height(const Io& io, Mask<F> active, const vec2<F>& uv) {
    const auto context = io.template context<TextureSlot::height>(active);
    if (heights_are_noise(io)) return noise_height(io, context, uv);
    return texture(height_map(io), context, uv, io.frame().derivatives).x;
}

/// Heights at the one level, a lane's own or its quad's, that a look-up at the undisplaced UV has.
template <class Io, class F = typename Io::Number>
MarchHeights<Io> heights_of_implicit_level(const Io& io, const vec2<F>& uv) {
    const SampledTexture& map = height_map(io);
    return {io, map, implicit_lod(map, uv, io.frame().derivatives)};
}

}  // namespace quadrel
