// bump-noise: a rough look from noise, without any map.
//
// Corrects bump-noise@published, which adds the noise's slope towards the first light to N.L. Here
// the normal is that of the surface raised by `height` times the noise, by its exact gradient:
//     n = normalize(N - height (h_u grad u + h_v grad v)),   h = noise(uv / scale) in [0, 1]
// To first order N.L changes by what the listing adds; but every light sees the same bumps,
// highlights too, whatever the surface's slope, and a light at the zenith has no direction to
// lack. The noise lies in texture coordinates, as the listing's lies in the plane of the terrain.
#pragma once

#include "quadrel/relief/surface/relief_normal.hpp"

namespace quadrel {

struct BumpNoise : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"bump-noise", "surface", "bumps of gradient noise",
                                    "correction of bump-noise@published"};
    static constexpr auto inputs =
        values(Value::frame_normal, Value::J, Value::frame_status, Value::hit_uv);
    static constexpr auto outputs = surface_outputs;
    struct Params {
        float scale = 0.125f, height = 0.05f;
        std::int32_t octaves = 1;
    };
    static constexpr std::array parameters{
        parameter<&Params::scale>("scale", "tile", "length of the first octave's cells", 1e-3, 1e3,
                                  0.125),
        parameter<&Params::height>("height", "world unit", "height that the noise spans", 0, 1e6,
                                   0.05),
        parameter<&Params::octaves>("octaves", "1", "octaves of the noise", 1, 10, 1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const auto noise =
            noise_field(io.template load<Value::hit_uv>(), 1 / params.scale, params.octaves);
        const F height(params.height);
        store_normal(io, relief_normal<Io, F>(io, noise.gradient, height), height != F(0));
    }
};

}  // namespace quadrel
