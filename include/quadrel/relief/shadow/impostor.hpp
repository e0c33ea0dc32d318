// shadow-impostor: a march from the hit towards the light through the depths of an impostor.
//
// After E. Risser, "True Impostors", GPU Gems 3, 2007, chapter 21, of whose text the abstract and
// the introduction were read: the light's ray goes through the layers as the view's does, as in
// F. Policarpo, M. M. Oliveira, "Relief Mapping of Non-Height-Field Surface Details", I3D 2006.
// Equal steps to where the ray leaves the cube of the layers, or to the light; dark where a sample
// is inside of a solid. Of one impostor alone: others cast nothing on it. Hard; no bias but the
// first step; misses what is thinner than a step.
#pragma once

#include "quadrel/relief/shadow/impostor_light.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct ShadowImpostor : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-impostor", "shadow",
                                    "march from the hit through up to twelve depths",
                                    "after Risser 2007, GPU Gems 3, chapter 21"};
    static constexpr auto inputs = impostor_light_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = impostor_maps;
    struct Params {
        std::int32_t steps = 64;
    };
    static constexpr std::array parameters{parameter<&Params::steps>(
        "steps", "1", "steps over the light's way in the cube", 1, most_steps, 64)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const ImpostorLight<F> light =
            impostor_light(io, vec3<F>(uv.x, uv.y, io.template load<Value::hit_s>()));
        const ImpostorLayers<Io> layers(io);
        Mask<F> active = light.active, occluded(false);
        Int<F> points(0);
        for (const auto k : steps<F>(1, params.steps)) {
            const F t = number<F>(k) / number<F>(params.steps);
            const auto sample = layers(active, light.place(t));
            count_in<F>(points, active);
            occluded = occluded | (active & sample.inside);
            active = active & !occluded;
            if (none(active)) break;
        }
        store_impostor_shadow(io, occluded, points);
    }
};

}  // namespace quadrel
