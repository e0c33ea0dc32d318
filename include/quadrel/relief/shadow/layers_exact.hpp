// shadow-layers-exact: every dual cell that the light ray crosses, its layers compared exactly.
//
// No source's search does this; it is shadow-exact for solids between layers. The ray starts on the
// layer next to the hit, at the UV of the hit, wherever the search for the hit stopped. In the
// patch where it starts that layer's quadratic is 0 at t = 0; the root is divided out, so that no
// bias is needed: dark where the ray is inside of the layer's solid right away or comes into it
// again. Of all other patches dark where the ray is inside by more than the rounding error on
// either side: a ray that only touches is lit. The field is that of level 0, whatever filters the
// sampler has; its wrap modes hold. Lit where a ray crosses more than 2^20 borders, or meets only
// NaN.
#pragma once

#include "quadrel/relief/shadow/dark_layers.hpp"
#include "quadrel/relief/shadow/light_cells.hpp"

namespace quadrel {

struct ShadowLayersExact : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-layers-exact", "shadow",
                                    "every cell towards the light, its layers exactly",
                                    "after Amanatides and Woo 1987; Ramsey et al. 2004"};
    static constexpr auto inputs = light_ray_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::layers);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const LightRay<F> light = light_ray(io);
        const SampledTexture& map = layer_map(io);
        LightCells<F> search(light, map);
        const auto cell_here = [&] {
            return cell_layers<F>(map, search.grid, search.stored_i(), search.stored_j());
        };
        CellLayers<F> cell = cell_here();
        const StartLayer<F> start =
            start_layer(cell, search.start, io.template load<Value::hit_s>());
        const F rise = start.depth;
        search.leave_after(rise);
        Mask<F> first(true);
        for (const auto k : rounds<F>()) {
            search.count_step(1, 2);
            if (none(search.active)) break;
            const CellExit<F> exit = search.exit(search.cell());
            const PatchRay<F> part = search.part_in_cell(exit);
            const F depth = rise * (F(1) - part.s);
            record(io, search.active, depth, light.uv + light.K * (part.s * rise), cell.layer[0]);
            const Mask<F> dark = is_dark<F>(cell, part, {depth, -rise}, first, start);
            search.hit(search.active & dark, part.s, F(0));
            first = Mask<F>(false);
            search.step(search.active, exit);
            cell = cell_here();
        }
        store_shadow(io, light, select(search.found, F(0), F(1)), search.result.steps);
    }

  private:
    template <class Io, class F>
    static void record(Io& io, Mask<F> active, F depth, const vec2<F>& uv,
                       const CellHeights<F>& front) {
        count_fetch(io.template context<TextureSlot::layers>(active));
        io.march_step(active, depth, uv, F(1) - depth, F(1) - front.h00);
    }
};

}  // namespace quadrel
