// shadow-march-thesis: the self-shadow march of the thesis, corrected.
//
// Corrects shadow-march-thesis@published: the ray and the heights are in the same units; the ray
// climbs from the hit to the top plane in steps of 1/n of the relief's depth, with the true shift
// K_L = (depth / L.N) J L; only lights behind the surface (L.N <= 0) are dark outright.
// Hard shadow; misses occluders thinner than |K_L| / n. Without depth nothing shadows.
#pragma once

#include "quadrel/relief/heights.hpp"

namespace quadrel {

struct ShadowMarchThesis : StageDefaults {
    static constexpr StageText text{"shadow-march-thesis", "shadow",
                                    "linear march from the hit up to the top plane",
                                    "correction of shadow-march-thesis@published"};
    static constexpr auto inputs =
        values(Value::relief_depth, Value::J, Value::frame_normal, Value::frame_status,
               Value::dUVdx, Value::dUVdy, Value::hit_uv, Value::hit_s, Value::hit_h, Value::hit_P);
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool uses_height_bounds = true;
    struct Params {
        std::int32_t steps = 128;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, 65536, 128)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), io.frame().lights[io.light()]);
        const F r = dot(L, io.template load<Value::frame_normal>());
        const Mask<F> lit_side = r > F(0);
        const Mask<F> framed =
            io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
        Int<F> steps(0);
        const Mask<F> occluded =
            march<F>(io, io.active() & lit_side & framed, L, r, params.steps, steps);
        io.template store<Value::shadow_visibility>(select(lit_side & !occluded, F(1), F(0)),
                                                    io.light());
        io.template store<Value::shadow_steps>(steps, io.light());
    }

  private:
    template <class F, class Io>
    static Mask<F> march(Io& io, Mask<F> active, const vec3<F>& L, F r, int n, Int<F>& steps) {
        Mask<F> occluded(false);
        const F depth = io.template load<Value::relief_depth>();
        active = active & (depth != F(0));
        if (!any(active)) return occluded;
        const auto J = io.template load<Value::J>();
        const vec2<F> K = vec2<F>(dot(J[0], L), dot(J[1], L)) / r * depth;
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const auto height = march_heights(io);
        // A march stops below the surface, by up to a step: the ray starts where the surface is.
        const F z = max(F(1) - io.template load<Value::hit_s>(), io.template load<Value::hit_h>());
        // Above the top plane, or the highest texel where it is known, nothing occludes.
        const F top(std::min(Scalar<F>(1), height_bounds(io).high));
        for (int k = 1; k < n; ++k) {
            const F t(static_cast<Scalar<F>>(k) / static_cast<Scalar<F>>(n));
            active = active & (z + t < top);
            if (!any(active)) break;
            const F h = height(active, uv + K * t);
            io.march_step(active, F(1) - (z + t), uv + K * t, z + t, h);
            steps = steps + select(active, Int<F>(1), Int<F>(0));
            occluded = occluded | (active & (h > z + t));
            active = active & !occluded;
        }
        return occluded;
    }
};

}  // namespace quadrel
