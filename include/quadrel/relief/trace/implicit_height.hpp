// Heights as texture() gives them, without gradients of one's own.
#pragma once

#include "quadrel/relief/trace/search.hpp"

namespace quadrel {

/// A look-up of the height map with implicit derivatives; all lanes need a coordinate.
template <class Io, class F = typename Io::Number>
F implicit_height(const Io& io, Mask<F> active, const vec2<F>& uv) {
    const SampledTexture& map = *io.template texture<TextureSlot::height>();
    const auto context = io.template context<TextureSlot::height>(active);
    return texture(map, context, uv, io.frame().derivatives).x;
}

}  // namespace quadrel
