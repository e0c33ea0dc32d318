// cone-dummer-exact: Dummer's cone stepping with a smallest step, backed off at the end.
//
// Source: J. Dummer, "Cone Step Mapping: An Iterative Ray-Heightfield Intersection Algorithm",
// 2006, intersect_exact: along the unit direction ds (K, -1 normalised, z taken positive), with iz
// = sqrt(1 - ds.z^2), sc grows by w = 1 / texels plus the cone's step until the surface is passed,
// then goes back by w. Kept: what is interpolated is the root of the ratio, which the source's map
// stores and its shader squares. Unbounded in the source; here a guard of 65536 steps ends it as
// CAP, and straight down a null cone, as of a border, its 0 / 0 is 0. Not reproduced: the 8 bits of
// the source's map (here heights and ratios are floats, of the same kind of cones).
#pragma once

#include "quadrel/relief/trace/cone/cone_map.hpp"

namespace quadrel {

struct ConeDummerExact : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"cone-dummer-exact", "trace",
                                    "cone steps of a texel or more, one texel back",
                                    "Dummer 2006, Cone Step Mapping"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr const char* not_reproduced =
        "the 8 bits of its map: heights and roots of cones are floats";
    static constexpr auto textures = slots(TextureSlot::cone);
    static constexpr int guard = 65536;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto look = cone_look_up<TextureSlot::cone, Interpolated::roots>(io);
        const TextureView& view = io.template texture<TextureSlot::cone>()->view;
        const vec3<F> ds = normalize(vec3<F>(ray.K, F(1)));
        const vec2<F> along(ds);
        const F w(Scalar<F>(1) / static_cast<Scalar<F>>(std::max(view.width[0], view.height[0])));
        const F iz = sqrt(F(1) - ds.z * ds.z);
        F sc(0);
        Mask<F> active = ray.active, found(false), met_nan(false);
        SearchResult<F> result;
        for (const auto k : steps<F>(1, guard)) {
            const Cone<F> t = look(active, ds.z * sc, ray.uv + along * sc);
            result.h = select(active, t.height, result.h);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(t.height));
            const Mask<F> above = F(1) - ds.z * sc > t.height;
            found = found | (active & !above);
            active = active & above;
            if (none(active)) break;
            // Straight down every cone, a null one of a border among them, is left at the surface.
            const F sideways = select(iz > F(0), iz / t.ratio, F(0));
            const F step = (F(1) - ds.z * sc - t.height) / (ds.z + sideways);
            sc = select(active, sc + w + step, sc);
        }
        sc = sc - w;
        result.s = ds.z * sc;
        result.status = search_status<F>(found, met_nan, Status::cap);
        result.fetches = result.steps;
        store_search(io, ray, result, ray.uv + along * sc);
    }
};

}  // namespace quadrel
