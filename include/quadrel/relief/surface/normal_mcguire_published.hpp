// normal-mcguire@published: the normal of steep parallax mapping's listing.
//
// Source: M. McGuire and M. McGuire, "Steep Parallax Mapping" (2005), the page's shader:
//     vec3 tsN = NB.xyz * 2 - 1;
// NB being what the march's last look-up gave. Kept: tsN is not normalised, and is as short as
// filtering makes it; its y axis is against growing v, as all of the page's tangent space; the
// look-up stands in the loop, so that a fragment's footprint is the distance to where its
// neighbours were when its own march ended: their final coordinates if they had ended before, the
// step of the same number if not. That is what it is after a march in equal steps (hit.steps
// look-ups, the first at the undisplaced coordinate, the last at the hit), as steep@published makes
// them; after other searches it is not reproduced, but about that. Handed on along the frame's T, B
// and normal as they are. The page keeps heights and normals in one map; here give the same file as
// height and normal. Without a map: the frame's normal.
#pragma once

#include "quadrel/relief/surface/normal_welsh_published.hpp"

namespace quadrel {

struct NormalMcGuirePublished : NormalFromMap {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"normal-mcguire@published", "surface",
                                    "normal of the map as the march met it, not normalised; green "
                                    "is against v",
                                    "McGuire and McGuire, Steep Parallax Mapping (2005)"};
    static constexpr const char* not_reproduced =
        "the footprint in the page's loop after other searches than its march in equal steps";
    static constexpr auto inputs = values_and(listed_normal_inputs, Value::uv, Value::hit_steps);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SampledTexture* map = io.template texture<TextureSlot::normal>();
        if (!map) return io.template store<Value::N>(io.template load<Value::frame_normal>());
        const vec3<F> tsN = signed_texel(last_texel(io, *map));
        store_along_frame(io, vec3<F>(tsN.x, -tsN.y, tsN.z));
    }

  private:
    /// texture2D(normalBumpMap, offsetCoord) in the step in which each fragment left the loop.
    template <class Io, class F = typename Io::Number>
    static vec4<F> last_texel(const Io& io, const SampledTexture& map) {
        const Mask<F> right = lane_is_right<F>(), below = lane_is_below<F>();
        const auto of_lane = [&](auto lane, Mask<F> is_lane, const vec4<F>& others) {
            return select(is_lane, texel_when<lane()>(io, map, is_lane), others);
        };
        vec4<F> texel(F(0));
        texel = of_lane(std::integral_constant<int, 0>(), (!right) & (!below), texel);
        texel = of_lane(std::integral_constant<int, 1>(), right & (!below), texel);
        texel = of_lane(std::integral_constant<int, 2>(), (!right) & below, texel);
        return of_lane(std::integral_constant<int, 3>(), right & below, texel);
    }

    /// The look-up of the quad in the step in which its fragment `lane` left the loop.
    template <int lane, class Io, class F = typename Io::Number>
    static vec4<F> texel_when(const Io& io, const SampledTexture& map, Mask<F> is_lane) {
        const vec2<F> first = io.template load<Value::uv>(),
                      hit = io.template load<Value::hit_uv>();
        const F last = max(to_float<F>(io.template load<Value::hit_steps>()) - F(1), F(0));
        const F step = broadcast_lane<lane>(last);
        const vec2<F> on_the_way = first + (hit - first) * (step / last);
        const vec2<F> offsetCoord = select(last <= step, hit, on_the_way);
        const auto context = io.template context<TextureSlot::normal>(io.active() & is_lane);
        return texture(map, context, offsetCoord, io.frame().derivatives);
    }
};

}  // namespace quadrel
