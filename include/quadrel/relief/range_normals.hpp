// Normals of bilinear patches on ranges (texture/range/patch.hpp): of heights, and of the depth
// layer that a ray has met.
#pragma once

#include "quadrel/relief/surface/h2n_impostor.hpp"
#include "quadrel/relief/surface/h2n_layers.hpp"
#include "quadrel/relief/surface/h2n_patch.hpp"
#include "quadrel/texture/range/patch.hpp"

namespace quadrel {

/// h2n-patch on ranges.
struct H2nPatchOnRanges : H2nPatch {
    template <class Io>
    void operator()(Io& io, const Params& params) const {
        if (heights_are_noise(io)) return H2nPatch::operator()(io, params);
        store_relief_normal(io, [&] {
            const SampledTexture& map = height_map(io);
            const range_detail::PatchRanges patch(map, io.template context<TextureSlot::height>(),
                                                  io.template load<Value::hit_uv>(), 0);
            return patch.slope * TexelSize<Ranges>(map).texels;
        });
    }
};

template <>
struct MetLayer<Ranges> {
    Ranges distance = Ranges(std::numeric_limits<double>::infinity());
    vec2<Ranges> slope = vec2<Ranges>(Ranges(0));
    RangeMask is_back = RangeMask(false);
    Int<Ranges> index = Int<Ranges>(0);

    void look_at(const SampledTexture& map, const SampleContext<Ranges>& context,
                 const vec2<Ranges>& uv, const Ranges& s, const vec2<Ranges>& K,
                 const Ranges& down) {
        const vec2<Ranges> texels = TexelSize<Ranges>(map).texels;
        const auto layer_at = [&](int layer) {
            if (layer >= map.view.channels)
                return LayerAt<Ranges>{abs(Ranges(1) - s), vec2<Ranges>(Ranges(0))};
            const range_detail::PatchRanges patch(map, context, uv, layer);
            return LayerAt<Ranges>{abs(patch.value - s), patch.slope * texels};
        };
        for (int front = 0; front < 4; front += 2)
            take_solid(*this, front, layer_at(front), layer_at(front + 1), K, down);
    }
};

}  // namespace quadrel
