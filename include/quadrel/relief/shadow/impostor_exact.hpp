// shadow-impostor-exact: every dual cell of an impostor's maps that the light ray crosses, its
// layers compared exactly.
//
// No source's search does this; it is shadow-layers-exact for rays any way through the cube of
// (u, v, s), of up to three maps. The ray starts on the layer next to the hit, of all maps, at the
// UV of the hit, and ends where it leaves the cube or at the light. A solid is what lies between a
// front and a back of one map: where solids of different maps overlap that is dark, while a search
// by parity is outside there. The field is that of level 0, whatever filters the sampler has. Lit
// where a ray crosses more than 2^20 borders, or meets only NaN.
#pragma once

#include "quadrel/relief/shadow/dark_layers.hpp"
#include "quadrel/relief/shadow/impostor_light.hpp"
#include "quadrel/relief/shadow/light_cells.hpp"

namespace quadrel {

struct ShadowImpostorExact : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-impostor-exact", "shadow",
                                    "every cell towards the light, of up to twelve depths, exactly",
                                    "after Amanatides and Woo 1987; Ramsey et al. 2004"};
    static constexpr auto inputs = impostor_light_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = impostor_maps;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        StartLayer<F> first = start_on<TextureSlot::layers>(io);
        StartLayer<F> second = start_on<TextureSlot::layers_2>(io);
        StartLayer<F> third = start_on<TextureSlot::layers_3>(io);
        keep_nearer(first, second);
        keep_nearer(first, third);
        keep_nearer(second, third);
        const F s = select(third.distance < never<F>(), third.depth,
                           select(second.distance < never<F>(), second.depth, first.depth));
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const ImpostorLight<F> light = impostor_light(io, vec3<F>(uv.x, uv.y, s));
        Mask<F> occluded(false);
        Int<F> points(0);
        walk<TextureSlot::layers>(io, light, first, occluded, points);
        walk<TextureSlot::layers_2>(io, light, second, occluded, points);
        walk<TextureSlot::layers_3>(io, light, third, occluded, points);
        store_impostor_shadow(io, occluded, points);
    }

  private:
    template <Number F>
    static F never() {
        return F(std::numeric_limits<Scalar<F>>::infinity());
    }

    /// The walk over a map's cells along the light's way, from the hit.
    template <class F>
    static LightCells<F> cells(const ImpostorLight<F>& light, const SampledTexture& map,
                               Mask<F> active) {
        const SearchRay<F> ray{vec2<F>(light.from.x, light.from.y),
                               vec2<F>(light.way.x, light.way.y),
                               F(1),
                               Scalar<F>(0),
                               active,
                               Int<F>(0),
                               Int<F>(0)};
        return {ray, map};
    }
    template <class F>
    static CellLayers<F> layers_of(const SampledTexture& map, const LightCells<F>& search) {
        CellLayers<F> cell = cell_layers<F>(map, search.grid, search.stored_i(), search.stored_j());
        return cell;
    }

    /// The layer of a map next to the hit; without a map, none.
    template <TextureSlot slot, class Io, class F = typename Io::Number>
    static StartLayer<F> start_on(const Io& io) {
        const Mask<F> no(false);
        const SampledTexture* const map = io.template texture<slot>();
        if (map == nullptr) return {F(0), never<F>(), {no, no, no, no}};
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const F s = io.template load<Value::hit_s>();
        const ImpostorLight<F> stays{vec3<F>(uv.x, uv.y, s), vec3<F>(F(0)), io.active()};
        const LightCells<F> search = cells(stays, *map, io.active());
        return start_layer(layers_of(*map, search), search.start, s);
    }
    /// Makes the farther one of two no layer at all; the second of equal ones.
    template <class F>
    static void keep_nearer(StartLayer<F>& a, StartLayer<F>& b) {
        const Mask<F> first = a.distance <= b.distance;
        const auto leave = [](StartLayer<F>& start, Mask<F> stays) {
            start.distance = select(stays, start.distance, never<F>());
            for (Mask<F>& own : start.is_own) own = own & stays;
        };
        leave(a, first);
        leave(b, !first);
    }

    template <TextureSlot slot, class Io, class F>
    static void walk(const Io& io, const ImpostorLight<F>& light, const StartLayer<F>& start,
                     Mask<F>& occluded, Int<F>& points) {
        const SampledTexture* const map = io.template texture<slot>();
        if (map == nullptr) return;
        LightCells<F> search = cells(light, *map, light.active & !occluded);
        Mask<F> first(true);
        for (const auto k : rounds<F>()) {
            search.count_step(1, 2);
            if (none(search.active)) break;
            const CellExit<F> exit = search.exit(search.cell());
            const PatchRay<F> part = search.part_in_cell(exit);
            const CellLayers<F> cell = layers_of(*map, search);
            const vec3<F> at = light.place(part.s);
            count_fetch(io.template context<slot>(search.active));
            io.march_step(search.active, at.z, vec2<F>(at.x, at.y), F(1) - at.z,
                          F(1) - cell.layer[0].h00);
            const Mask<F> dark = is_dark<F>(cell, part, {at.z, light.way.z}, first, start);
            search.hit(search.active & dark, part.s, F(0));
            first = Mask<F>(false);
            search.step(search.active, exit);
        }
        occluded = occluded | search.found;
        points = points + search.result.steps;
    }
};

}  // namespace quadrel
