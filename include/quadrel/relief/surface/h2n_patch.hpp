// h2n-patch: the exact slopes of the height field that an exact search finds, at the hit.
//
// Heights of a map: the bilinear patch of level 0 between the four texel centres around,
//     h_u = W lerp(h10 - h00, h11 - h01, g),   h_v = H lerp(h01 - h00, h11 - h10, f),
// f and g the weights of the look-up. The slopes jump at the borders of the patches: the right
// normal of that surface, which therefore looks faceted. One gather. Heights of noise: its
// gradient.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct H2nPatch : NormalFromHeights {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"h2n-patch", "surface", "exact normal of the height field",
                                    "gradient of the bilinear interpolant"};
    static constexpr auto inputs = relief_normal_inputs;
    static constexpr bool reads_finest_heights_only = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        store_relief_normal(io, [&] {
            const vec2<F> uv = io.template load<Value::hit_uv>();
            const SampleContext<F> context = io.template context<TextureSlot::height>();
            const MaterialUniforms& m = io.material();
            if (heights_are_noise(io))
                return noise_fetch(context, uv, m.noise_frequency, m.noise_octaves).gradient;
            return patch_slope<F>(height_map(io), context, uv);
        });
    }

  private:
    template <class F>
    static vec2<F> patch_slope(const SampledTexture& map, const SampleContext<F>& context,
                               const vec2<F>& uv) {
        const vec4<F> h = texture_gather(map, context, uv);
        const F h01 = h.x, h11 = h.y, h10 = h.z, h00 = h.w;
        const Footprint<F> at = address(map, level_geometry<F>(map.view, 0), uv, Filter::linear);
        const vec2<F> rise(lerp(h10 - h00, h11 - h01, at.y.weight),
                           lerp(h01 - h00, h11 - h10, at.x.weight));
        return rise * TexelSize<F>(map).texels;
    }
};

}  // namespace quadrel
