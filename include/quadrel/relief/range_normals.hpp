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
                 const vec2<Ranges>& uv, const Ranges& s) {
        const vec2<Ranges> texels = TexelSize<Ranges>(map).texels;
        for (int layer = 0; layer < 4; ++layer) {
            Ranges depth(1);
            vec2<Ranges> steps(Ranges(0));
            if (layer < map.view.channels) {
                const range_detail::PatchRanges patch(map, context, uv, layer);
                depth = patch.value;
                steps = patch.slope;
            }
            const Ranges from_hit = abs(depth - s);
            const RangeMask nearer = from_hit < distance;
            distance = select(nearer, from_hit, distance);
            slope = select(nearer, steps * texels, slope);
            is_back = layer % 2 == 0 ? is_back & !nearer : is_back | nearer;
            index = select(nearer, Int<Ranges>(layer), index);
        }
    }
};

}  // namespace quadrel
