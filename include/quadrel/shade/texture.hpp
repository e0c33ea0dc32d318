// shade-texture: the colour map, unlit. What sampler scenes show. Without a map: white.
#pragma once

#include "quadrel/shade/maps.hpp"

namespace quadrel {

struct ShadeTexture : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shade-texture", "shade", "the colour map, unlit", "-"};
    static constexpr auto inputs = values(Value::dUVdx, Value::dUVdy, Value::hit_uv);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);
    using Params = MapParams;
    static constexpr auto parameters = map_parameters;

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec4<F> texel = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)), params.gradients);
        io.template store<Value::color>(rgb(texel));
        io.template store<Value::opacity>(texel.w);
    }
};

}  // namespace quadrel
