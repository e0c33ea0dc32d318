// h2n-thesis: the normal of the thesis, corrected.
//
// Corrects h2n-thesis@published: central differences one texel apart in u and v instead of a fixed
// world distance; the face's relief normal is made on the right side before the smooth-shading
// difference (vertex normal minus face normal) is added; the sum is normalised.
//     m = normalize(Nf - depth * (h_u grad u + h_v grad v)),   n = normalize(m + (N - Nf))
// Heights are fetched with the gradients of the undisplaced UV. Depth 0 gives the frame's normal.
#pragma once

#include "quadrel/relief/view.hpp"
#include "quadrel/texture/height_sampler.hpp"

namespace quadrel {

struct H2nThesis : NormalFromHeights {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"h2n-thesis", "surface",
                                    "normal from central differences of the height, smooth shaded",
                                    "correction of h2n-thesis@published"};
    static constexpr auto inputs =
        values(Value::P, Value::Ng, Value::relief_depth, Value::frame_normal, Value::J,
               Value::frame_status, Value::dUVdx, Value::dUVdy, Value::hit_uv);
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> N = io.template load<Value::frame_normal>();
        const F depth = io.template load<Value::relief_depth>();
        const Mask<F> deep = depth != F(0);
        const Mask<F> framed =
            io.template load<Value::frame_status>() == status_packet<F>(Status::hit);
        vec3<F> n = N;
        if (when(deep)) n = select(framed & deep, smooth_normal(io, N, depth), N);
        io.template store<Value::N>(n);
    }

  private:
    template <class Io, class F>
    static vec3<F> smooth_normal(const Io& io, const vec3<F>& N, F depth) {
        const vec3<F> Ng = io.template load<Value::Ng>();
        const vec3<F> V = to_viewer(io.template load<Value::P>(), io.frame());
        const vec3<F> Nf = select(dot(Ng, V) < F(0), -Ng, Ng);
        const auto J = io.template load<Value::J>();
        const vec2<F> slope = height_slope<F>(io);
        const vec3<F> m = normalize(Nf - (J[0] * slope.x + J[1] * slope.y) * depth);
        return normalize(m + (N - Nf));
    }

    /// (dh/du, dh/dv) by central differences over two texels of level 0.
    template <class F, class Io>
    static vec2<F> height_slope(const Io& io) {
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        const GeneralHeight<F> sampler(map, io.template load<Value::dUVdx>(),
                                       io.template load<Value::dUVdy>());
        const vec2<F> uv = io.template load<Value::hit_uv>();
        const TexelSize<F> size(map);
        const vec2<F> du(size.step.x, F(0)), dv(F(0), size.step.y);
        const auto h = [&](const vec2<F>& at) {
            return sampler(io.template context<TextureSlot::height>(), at);
        };
        return {(h(uv + du) - h(uv - du)) * size.texels.x * F(0.5f),
                (h(uv + dv) - h(uv - dv)) * size.texels.y * F(0.5f)};
    }
};

}  // namespace quadrel
