// lod: the level-of-detail record of the undisplaced UV on the height map, or on the colour map of
// a material that has no height map, as textureQueryLod tells it: of hardware whose look-ups with
// implicit derivatives take lane 0's level for the quad, that one.
#pragma once

#include "quadrel/quad/shared_scales.hpp"

namespace quadrel {

/// Lane 0's record in all lanes of its quad.
template <Packet F>
LodRecord<F> lod_of_quad(const LodRecord<F>& own) {
    LodRecord<F> lod = own;
    for (F LodRecord<F>::*number :
         {&LodRecord<F>::rho, &LodRecord<F>::lambda, &LodRecord<F>::level, &LodRecord<F>::frac})
        lod.*number = broadcast_lane<0>(own.*number);
    return lod;
}

struct LevelOfDetail : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{
        "lod", "quad", "footprint and mip level of the undisplaced UV",
        "Vulkan specification, texel scale factors and level of detail"};
    static constexpr auto inputs = values(Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs =
        values(Value::lod_rho, Value::lod_lambda, Value::lod_level, Value::lod_frac);
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::color);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SampledTexture* height = io.template texture<TextureSlot::height>();
        const SampledTexture* map = height ? height : io.template texture<TextureSlot::color>();
        LodRecord<F> lod{};
        if (map) lod = undisplaced_lod(io, *map, LodUse::shown);
        if (map && map->sampler.quad_lod != 0) lod = lod_of_quad(lod);
        io.template store<Value::lod_rho>(lod.rho);
        io.template store<Value::lod_lambda>(lod.lambda);
        io.template store<Value::lod_level>(lod.level);
        io.template store<Value::lod_frac>(lod.frac);
    }
};

}  // namespace quadrel
