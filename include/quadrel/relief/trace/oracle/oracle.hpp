// oracle: where the view ray first meets the height field, proven, beside whatever the trace found.
//
// No source's: exact judges are not searches, and take the time that they need. Runs when a channel
// asks for oracle.* or certified. The surface is that which the material's trace searches: blocks
// where it reads maxima of texels, else bilinear patches; an oracle-* trace has its own and stores
// these values itself. Without a height map (noise, none) nothing is proven.
#pragma once

#include "quadrel/relief/trace/oracle/lanes.hpp"

namespace quadrel {

struct Oracle : StageDefaults {
    static constexpr StageText text{"oracle", "oracle",
                                    "the first point of the height field on the ray, proven", "-"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = oracle_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool reads_finest_heights_only = true;

    struct Params {
        std::int32_t surface = 0;
    };
    static constexpr std::array parameters{oracle::surface_parameter<&Params::surface>()};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using T = Scalar<typename Io::Number>;
        const auto surface = static_cast<oracle::Surface>(params.surface);
        store_hits(io, oracle::QuadHits<T>(io, search_ray(io), surface));
    }
};

}  // namespace quadrel
