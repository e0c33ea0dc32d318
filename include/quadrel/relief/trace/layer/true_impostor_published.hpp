// true-impostor@published: a march through four depths behind a card, by products, as listed.
//
// Source: the program of E. Risser, "True Impostors", GPU Gems 3, 2007, chapter 21, on the book's
// disc (21/source: its two loops, "linear search" and "bisection search"; a second program there
// refracts the ray at each collision and is not here). With viewVec the unit vector to the viewer
// and heights scaled to hscale (tex - 1/2):
//   * depth is viewOrigin.z + dis viewVec.z, uv is viewOrigin.xy - dis viewVec.xy;
//   * outside is where the product of the four differences of depths is above 0: a sample on a
//     layer, or where a front and a back are equal at the ray's depth, is a collision;
//   * the linear search makes a step less than it is told, has no exit, and where it has met
//     something looks up the same place until its end;
//   * the bisection halves the step and goes on or back, whether anything was met or not; it keeps
//     no bracket, and where it ends was not tested.
// The program does not say where viewOrigin is, how long a step is, what hscale is, and which rays
// are misses. Here, in tiles: the ray begins where it comes into the cube of the layers, in front
// of the eye; a step is `step`; hscale is depth over tile; a ray none of whose samples collides is
// a miss, CLIP, on the card. Look-ups take implicit derivatives, as tex2D does.
#pragma once

#include "quadrel/relief/trace/layer/impostor_layers.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"

namespace quadrel {

/// What the program takes for granted, in tiles.
template <Number F>
struct ImpostorProgram {
    vec3<F> view_origin;  ///< u, v, and the depth below the middle of the layers
    vec3<F> view;         ///< unit, to the viewer, along growing u and v and out of the layers
    F hscale;
};
template <class Io, class F = typename Io::Number>
ImpostorProgram<F> impostor_program(const Io& io, const ImpostorRay<F>& ray) {
    const ImpostorVolume<F>& volume = ray.volume;
    const F depth = io.template load<Value::relief_depth>();
    const F hscale = select(ray.active, depth / volume.tile, F(1));
    const vec3<F> enters = ray.place(select(ray.active, ray.part.from, F(0)));
    const vec3<F>& V = ray.to_viewer;
    return {{enters.x, enters.y, (enters.z - F(0.5f)) * hscale},
            {dot(volume.x, V), dot(volume.y, V), dot(volume.z, V)},
            hscale};
}

struct TrueImpostorPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr StageText text{"true-impostor@published", "trace",
                                    "march through four depths behind a card, as listed",
                                    "Risser 2007, GPU Gems 3, chapter 21, the disc's program"};
    static constexpr auto inputs = impostor_ray_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);
    struct Params {
        std::int32_t steps = 128, binary_steps = 7;
        float step = 0.015625f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps; one less is made", 1, most_steps, 128),
        parameter<&Params::binary_steps>("binary_steps", "1", "half steps", 0, 60, 7),
        parameter<&Params::step>("step", "tiles", "length of a step", 0, 16, 0.015625)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const ImpostorRay<F> ray = impostor_ray(io);
        const ImpostorProgram<F> program = impostor_program(io, ray);
        const vec3<F>&origin = program.view_origin, &view = program.view;
        const F hscale = program.hscale;
        Int<F> points(0);
        Mask<F> met_nan(false), found(false);
        // Whether the place at `dis` is outside.
        const auto is_free = [&](F dis) {
            const F depth = origin.z + dis * view.z;
            const vec2<F> uv(dis * -view.x + origin.x, dis * -view.y + origin.y);
            const auto context = io.template context<TextureSlot::layers>(ray.active);
            const SampledTexture& map = layer_map(io);
            const vec4<F> texel =
                layer_depths(map, texture(map, context, uv, io.frame().derivatives));
            const auto from = [&](F x) {
                return depth - ((x * hscale + (F(1) - hscale) / F(2)) - F(0.5f));
            };
            const F s = depth / hscale + F(0.5f);
            io.march_step(ray.active, s, uv, F(1) - s, F(1) - nearest_layer<4>(texel, s));
            count_in<F>(points, ray.active);
            met_nan = met_nan | (ray.active & has_nan<4>(texel));
            const F product = from(texel.x) * from(texel.y) * from(texel.z) * from(texel.w);
            const Mask<F> outside = product > F(0);
            found = found | (ray.active & !outside);
            return outside;
        };
        F dis(0), step(params.step);
        for (const auto i : steps<F>(1, params.steps - 1))
            dis = select(is_free(dis), dis + step, dis);
        for (const auto i : steps<F>(1, params.binary_steps)) {
            const Mask<F> outside = is_free(dis);
            step = step * F(0.5f);
            dis = select(outside, dis + step, dis - step);
        }
        const F t = select(found, ray.part.from + dis * ray.volume.tile, F(0));
        const F h = F(1) - clamp(ray.place(t).z, F(0), F(1));
        store_impostor(io, ray, {t, h, found, met_nan, points}, 1);
    }
};

}  // namespace quadrel
