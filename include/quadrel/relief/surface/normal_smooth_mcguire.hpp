// normal-smooth-mcguire: a normal map, smoothed along the relief's gradient.
//
// Source: M. McGuire and M. McGuire, "Steep Parallax Mapping" (2005), the page's shader, "Smooth
// normals locally along gradient to avoid making slices visible": the normal at the hit plus the
// one per step downhill from it, normalised. The page leaves the step open ("a function of the
// resolution and of the bump scale"): here `distance` texels of the normal map for a normal that
// lies in the surface, less as it stands up. Texels are x, y, z; green "down" is the page's own
// direction of v. Conventions: tangent_normal.hpp. Without a map: the frame's normal.
#pragma once

#include "quadrel/relief/surface/tangent_normal.hpp"

namespace quadrel {

struct NormalSmoothMcGuire : NormalFromMap {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"normal-smooth-mcguire", "surface",
                                    "normal map, smoothed along the gradient",
                                    "McGuire and McGuire, Steep Parallax Mapping (2005)"};
    static constexpr auto inputs = tangent_normal_inputs;
    struct Params {
        float distance = 1;
        std::int32_t green = 1, gradients = 0;
    };
    static constexpr std::array parameters{
        parameter<&Params::distance>("distance", "texel", "step to the second look-up", 0, 64, 1),
        green_parameter<&Params::green>(), gradients_parameter<&Params::gradients>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SampledTexture* map = io.template texture<TextureSlot::normal>();
        if (!map) return io.template store<Value::N>(io.template load<Value::frame_normal>());
        const vec3<F> green(F(1), F(static_cast<float>(params.green < 0 ? -1 : 1)), F(1));
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const vec3<F> here = signed_texel(io, *map, uv, params.gradients) * green;
        const vec2<F> step = TexelSize<F>(*map).step * F(params.distance);
        const vec2<F> downhill = uv + vec2<F>(here.x, here.y) * step;
        const vec3<F> sum = signed_texel(io, *map, downhill, params.gradients) * green + here;
        const EyeNormal<F> eye = tangent_to_eye(io, sum);
        store_normal(io, eye.n, eye.valid);
    }
};

}  // namespace quadrel
