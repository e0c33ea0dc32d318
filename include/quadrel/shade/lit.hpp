// Reflection models without an environment: base colour, gloss and emissive maps, lights, and how
// the result is stored. A model gives its highlight; see lights.hpp for the rest.
//
// Colour map: base rgb, opacity a. Gloss map: r = shininess / 255; without it, the material's
// shininess. Emissive map: rgb. color = emission + emissive + ambient + diffuse + specular.
#pragma once

#include "quadrel/shade/lights.hpp"

namespace quadrel {

/// What these models store: the terms that they have, colour and opacity.
inline constexpr auto lit_outputs =
    values(Value::light_ambient, Value::light_diffuse, Value::light_specular, Value::light_emissive,
           Value::color, Value::opacity);

inline constexpr auto lit_textures =
    slots(TextureSlot::color, TextureSlot::gloss, TextureSlot::emissive);

/// Inputs, outputs, maps and parameters of such a model.
struct LitDefaults : StageDefaults {
    using Params = MapParams;
    static constexpr auto parameters = map_parameters;
    static constexpr auto inputs = lit_inputs;
    static constexpr auto outputs = lit_outputs;
    static constexpr auto textures = lit_textures;
};

/// A shading point: unit normal, unit vector to the viewer, exponent of the highlight, not below 0:
/// texels outside of [0, 1] are permitted, and a negative power of a cosine of 0 is infinite.
template <Number F>
struct LitPoint {
    vec3<F> N, V;
    F shininess;
};

template <class Io, class F = typename Io::Number>
LitPoint<F> lit_point(Io& io, std::int32_t gradients = 0) {
    const F shininess(io.material().shininess / 255.0f);
    const vec4<F> gloss =
        map_at_hit<TextureSlot::gloss>(io, vec4<F>(shininess, F(0), F(0), F(0)), gradients);
    return {io.template load<Value::N>(), to_viewer(io.template load<Value::P>(), io.frame()),
            max(F(255) * gloss.x, F(0))};
}

/// Stores the terms and their sum; without `shines` there is no specular one to add.
template <bool shines = true, class Io, class F = typename Io::Number>
void store_lit(Io& io, const LightTerms<F>& sum, const vec4<F>& base, const Emission<F>& emissive) {
    const vec3<F> matte = emissive.with(sum.ambient) + sum.diffuse;
    io.template store<Value::light_ambient>(sum.ambient);
    io.template store<Value::light_diffuse>(sum.diffuse);
    io.template store<Value::light_specular>(sum.specular);
    io.template store<Value::light_emissive>(emissive.light);
    io.template store<Value::color>(shines ? matte + sum.specular : matte);
    io.template store<Value::opacity>(base.w);
}

/// Lights a point of that colour and opacity with the model's `specular` and stores everything.
template <class Io, class Specular, class F = typename Io::Number>
void shade_lit(Io& io, const vec4<F>& base, const vec3<F>& N, const Specular& specular,
               std::int32_t gradients) {
    const Emission<F> emissive = emission_at_hit(io, gradients);
    constexpr bool shines = !std::is_same_v<decltype(specular(N, F(0))), NoHighlight>;
    store_lit<shines>(io, sum_lights(io, rgb(base), N, specular), base, emissive);
}

/// The same of the colour map's colour.
template <class Io, class Specular>
void shade_lit(Io& io, const vec3<typename Io::Number>& N, const Specular& specular,
               std::int32_t gradients = 0) {
    using F = typename Io::Number;
    shade_lit(io, map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)), gradients), N, specular,
              gradients);
}

}  // namespace quadrel
