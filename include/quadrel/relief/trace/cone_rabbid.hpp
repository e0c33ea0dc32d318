// cone-rabbid: the cone stepping of Rabbid76's page, as listed.
//
// Source: Rabbid76, "Parallax Mapping" (github.com/Rabbid76/graphics-snippets), function ConeStep;
// texDir3D is the unit view ray in texture space, (K, -1) normalised. t is a length along it. Kept:
//   * at least one texel a step, 30 steps, no refinement: one-texel features are stepped over, and
//     a ray that has not arrived is returned where it is (status CAP);
//   * straight down, normalize(0, 0) and the division by R.x are not numbers;
//   * heights and ratios are clamped to [0, 1].
// The listing returns the height of the undisplaced point; hit.h is that of the last sample.
#pragma once

#include "quadrel/relief/trace/cone_map.hpp"

namespace quadrel {

struct ConeRabbid : StageDefaults {
    static constexpr StageText text{"cone-rabbid", "trace", "cone steps of a texel or more, 30",
                                    "Rabbid76, graphics-snippets, Cone Step Mapping"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::cone);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto look = cone_look_up<TextureSlot::cone>(io);
        const vec3<F> texDir3D = normalize(vec3<F>(ray.K, F(-1)));
        const vec2<F> direction(texDir3D);
        const vec2<F> R = normalize(vec2<F>(length(direction), texDir3D.z));
        const vec2<F> P = R / texDir3D.z;
        const F min_step = length(normalize(direction) /
                                  TexelSize<F>(*io.template texture<TextureSlot::cone>()).texels) *
                           F(1) / R.x;
        Mask<F> active = ray.active, found(false), met_nan(false);
        F t(0);
        SearchResult<F> result;
        for (int i = 0; i < 30; ++i) {
            const vec2<F> at = ray.uv + direction * t;
            const Cone<F> sample = look(active, -texDir3D.z * t, at);
            const F h = clamp(sample.height, F(0), F(1)), c = clamp(sample.ratio, F(0), F(1));
            result.h = select(active, h, result.h);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(sample.height));
            const vec2<F> C = P + R * t;
            const Mask<F> hit = active & (C.y <= h);
            found = found | hit;
            active = active & !hit;
            if (!any(active)) break;
            const vec2<F> Q(C.x, h);
            const vec2<F> S = normalize(vec2<F>(c, F(1)));
            const vec2<F> across(S.y, -S.x);
            const F new_t = dot(Q - P, across) / dot(R, across);
            t = select(active, max(t + min_step, new_t), t);
        }
        result.s = -texDir3D.z * t;
        result.status = search_status<F>(found, met_nan, Status::cap);
        result.fetches = result.steps;
        store_search(io, ray, result, ray.uv + direction * t);
    }
};

}  // namespace quadrel
