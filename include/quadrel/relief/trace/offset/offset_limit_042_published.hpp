// offset-limit-042@published: the height map of Unity's built-in shaders, as listed.
//
// Source: Unity, built-in shaders, UnityCG.cginc, ParallaxOffset(h, height, viewDir): the height
// runs from -height / 2 to height / 2, the view vector is normalised, 0.42 is added to its z, and
// the offset is the height times (v.xy / v.z). `scale` (its height) is a UV length, 0.02 unless a
// material says otherwise; the relief's depth and seat move hit.depth alone. (Unity reads the green
// channel, here it is channel 0, with implicit derivatives; URP's ParallaxOffset1Step is the same.)
// viewDir is the caller's: Unity 4 makes it at the vertices, later versions at the fragment; here
// it is the frame's, a fragment. Not reproduced: half precision, which mobile targets have.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/tangent_eye.hpp"

namespace quadrel {

struct OffsetLimit042Published : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"offset-limit-042@published", "trace",
                                    "Unity's parallax offset, height centred, z raised by 0.42",
                                    "Unity, UnityCG.cginc, ParallaxOffset"};
    static constexpr const char* not_reproduced =
        "viewDir, the caller's, made at vertices or fragments by Unity's version: here at "
        "fragments, of the frame; the channel (.g): the height map's swizzle chooses it; half "
        "precision on mobile";
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs = tangent_search_inputs;
    struct Params {
        float scale = 0.02f;
    };
    static constexpr std::array parameters{
        parameter<&Params::scale>("scale", "UV", "UV length of the height range", 0, 16, 0.02)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F texel = implicit_height_at_start(io, ray), height(params.scale);
        const F h = texel * height - height / F(2);
        vec3<F> v = normalize(tangent_eye(io));
        v.z = v.z + F(0.42f);
        store_search(io, ray, offset_result(ray, texel), ray.uv + vec2<F>(v) / v.z * h);
    }
};

}  // namespace quadrel
