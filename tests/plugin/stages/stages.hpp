// Stages of someone else's, for a plugin and for a program: one of each kind that is worth testing.
#pragma once

#include "quadrel/plugin.hpp"

namespace plugin_tests {

using namespace quadrel;

/// A search with parameters, look-ups, neighbours and one of num's own functions; no surface that
/// anyone would want to see.
struct Waves : StageDefaults {
    static constexpr StageText text{"test-waves", "trace", "heights under a wave", "these tests"};
    static constexpr const char* not_reproduced = "ebb and flow";
    static constexpr auto inputs = search_inputs_and(Value::P, Value::vertex_normal);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    struct Params {
        std::int32_t steps = 12;
        float phase = 0.25f;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the relief's depth", 1, 64, 12),
        parameter<&Params::phase>("phase", "rad", "where the wave begins", -7, 7, 0.25)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const auto heights = march_heights(io);
        SearchResult<F> found;
        Mask<F> active = ray.active, hit(false), nan(false);
        for (int k = 0; k <= params.steps; ++k) {
            const F s = F(static_cast<Scalar<F>>(k)) / F(static_cast<Scalar<F>>(params.steps));
            const F wave = sin(ray.at(s).x * 20.0f + Scalar<F>(params.phase));
            const F h = heights(active, ray.at(s)) * (F(0.75f) + F(0.25f) * wave);
            io.march_step(active, s, ray.at(s), F(1) - s, h);
            const Mask<F> below = active & (h >= F(1) - s);
            found.s = select(below, s, found.s);
            found.h = select(active, h, found.h);
            count_in<F>(found.steps, active);
            nan = nan | (active & is_nan(h));
            hit = hit | below;
            active = active & !below;
            if (!any(active)) break;
        }
        found.status = search_status<F>(hit, nan);
        found.fetches = found.steps;
        store_search(io, ray, found);
    }
};

/// A normal from the neighbours of the hit.
struct Tilt : StageDefaults {
    static constexpr StageText text{"test-tilt", "surface", "normal of the quad's hits",
                                    "these tests"};
    static constexpr auto inputs = values(Value::hit_P, Value::frame_normal);
    static constexpr auto outputs = surface_outputs;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        const auto P = io.template load<Value::hit_P>();
        const auto n = cross(dFdx(P), dFdy(P)) + io.template load<Value::frame_normal>();
        io.template store<Value::N>(normalize(n));
    }
};

/// A colour without the terms of the thesis.
struct Stripes : StageDefaults {
    static constexpr StageText text{"test-stripes", "shade", "colour map in stripes",
                                    "these tests"};
    static constexpr auto inputs =
        values(Value::dUVdx, Value::dUVdy, Value::hit_uv, Value::hit_P, Value::N);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec4<F> texel = map_at_hit<TextureSlot::color>(io, vec4<F>(F(1)));
        const vec3<F> N = io.template load<Value::N>();
        const F stripe =
            smoothstep(F(0.4f), F(0.6f), fract(io.template load<Value::hit_uv>().y * F(7)));
        io.template store<Value::color>(rgb(texel) * (stripe + exp2(-abs(N.z))));
        io.template store<Value::opacity>(texel.w);
    }
};

}  // namespace plugin_tests
