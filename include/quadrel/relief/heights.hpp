// The height field of a march: the material's height map, by the cheaper of two equal ways.
#pragma once

#include "quadrel/relief/view.hpp"
#include "quadrel/texture/height_sampler.hpp"

namespace quadrel {

/// Heights at uv for a whole march, its level of detail settled beforehand. The short way is taken
/// when every lane reads one level, bilinearly, of a map of one channel; it has the same bits.
template <class Io>
class MarchHeights {
  public:
    using F = typename Io::Number;

    MarchHeights(const Io& io, const SampledTexture& map, const LodRecord<F>& lod)
        : io_(io), general_(map, lod), fast_(map, general_.levels()) {
        short_way_ = io.call().log == nullptr && FastHeight<F>::applies(map, general_.levels());
    }

    /// `active`: the lanes that ask. One fetch each.
    F operator()(Mask<F> active, const vec2<F>& uv) const {
        const SampleContext<F> context = io_.template context<TextureSlot::height>(active);
        return short_way_ ? fast_(context, uv) : long_way(context, uv);
    }

    const LodRecord<F>& lod() const { return general_.lod(); }

  private:
    /// Out of line: one copy of all filters and formats in a row, however often it fetches.
    [[gnu::noinline]] F long_way(const SampleContext<F>& context, const vec2<F>& uv) const {
        return general_(context, uv);
    }

    const Io& io_;
    GeneralHeight<F> general_;
    FastHeight<F> fast_;
    bool short_way_;
};

/// Heights with the gradients of the undisplaced UV (textureGrad): what marches read unless their
/// source says otherwise. The stage loads dUVdx and dUVdy.
template <class Io>
MarchHeights<Io> march_heights(const Io& io) {
    const SampledTexture& map = *io.template texture<TextureSlot::height>();
    return {io, map,
            compute_lod(map, io.template load<Value::dUVdx>(), io.template load<Value::dUVdy>())};
}

/// Heights of a level of detail a lane, 0 the finest; the sampler's bias and clamps apply
/// (textureLod).
template <class Io, class F = typename Io::Number>
MarchHeights<Io> march_heights_of_level(const Io& io, F level) {
    const SampledTexture& map = *io.template texture<TextureSlot::height>();
    return {io, map, lod_from_level(map, level)};
}

}  // namespace quadrel
