// true-impostor: a march through up to six solids, twelve depths of three maps, along the view ray
// behind a card that faces the camera.
//
// Source: E. Risser, "True Impostors", 2006, and GPU Gems 3, 2007, chapter 21. Read of it were the
// abstract and the introduction of both, and the program on the book's disc, which is
// true-impostor@published. The ray is searched in the cube of the layers, in front of the eye.
// Corrects the program: steps are indexed and as many for each ray; where front and back are equal
// there is nothing (a product of 0 is a collision there); what is inside is so of one map or
// another (parity over all of them); the halvings keep a bracket. Not there: refraction,
// reflection, distances through the volume, animation.
//
// Misses what is thinner along the ray than a step; at most 2^-binary_steps of a step late, never
// early. hit.depth is the way along the ray from the card, negative in front of it.
#pragma once

#include "quadrel/relief/trace/layer/impostor_layers.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

struct TrueImpostor : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr StageText text{"true-impostor", "trace",
                                    "march through up to twelve depths behind a card",
                                    "Risser 2006, True Impostors; GPU Gems 3, chapter 21"};
    static constexpr auto inputs = impostor_ray_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = impostor_maps;
    struct Params {
        std::int32_t steps = 64, binary_steps = 7;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the ray's part in the cube", 1,
                                  most_steps, 64),
        parameter<&Params::binary_steps>("binary_steps", "1", "halvings of the last step", 0, 60,
                                         7)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const ImpostorLayers<Io> layers(io);
        const ImpostorRay<F> ray = impostor_ray(io);
        const F first = select(ray.active, ray.part.from, F(0));
        const F length = select(ray.active, ray.part.to - ray.part.from, F(0));
        F outside = first, inside = first;
        F depth(1);
        Mask<F> found(false), met_nan(false), active = ray.active;
        Int<F> points(0);
        for (const auto k : steps<F>(0, params.steps)) {
            const F t = first + length * (number<F>(k) / number<F>(params.steps));
            const auto sample = layers(active, ray.place(t));
            const Mask<F> enters = active & sample.inside;
            count_in<F>(points, active);
            met_nan = met_nan | (active & sample.met_nan);
            inside = select(enters, t, inside);
            depth = select(enters, sample.depth, depth);
            found = found | enters;
            active = active & !enters;
            outside = select(active, t, outside);
            if (none(active)) break;
        }
        for (const auto k : steps<F>(1, params.binary_steps)) {
            const F middle = (outside + inside) * F(0.5f);
            const auto sample = layers(found, ray.place(middle));
            const Mask<F> enters = found & sample.inside;
            count_in<F>(points, found);
            met_nan = met_nan | (found & sample.met_nan);
            inside = select(enters, middle, inside);
            depth = select(enters, sample.depth, depth);
            outside = select(found & !enters, middle, outside);
        }
        const F t = select(found, inside, F(0));
        store_impostor(io, ray, {t, F(1) - depth, found, met_nan, points}, layers.maps());
    }
};

}  // namespace quadrel
