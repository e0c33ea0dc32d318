// unreal-bump-offset: Unreal Engine's BumpOffset material expression.
//
// Source: Epic Games, documentation of UMaterialExpressionBumpOffset: its output is
//     Coordinate + Eye.xy * (Height - ReferencePlane) * HeightRatio,
// Eye the unit vector to the camera in tangent space, not divided by its z: offset limiting.
// Typical ratios are 0.02 to 0.1, a UV length; the reference plane, the height that stays where it
// is, is 0.5 unless set. The height is whatever the material's graph supplies, here the height map
// with implicit derivatives. The relief's depth and seat move hit.depth alone.
// (Products are taken from left to right; the engine's compiler may order them otherwise.)
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/tangent_eye.hpp"

namespace quadrel {

struct UnrealBumpOffset : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"unreal-bump-offset", "trace", "Unreal Engine's BumpOffset",
                                    "Epic Games, UMaterialExpressionBumpOffset"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the engine's own code, which is not public: the formula is that of its documentation";
    struct Params {
        float height_ratio = 0.05f, reference_plane = 0.5f;
    };
    static constexpr std::array parameters{
        parameter<&Params::height_ratio>("height_ratio", "UV", "UV length of the height range", -16,
                                         16, 0.05),
        parameter<&Params::reference_plane>("reference_plane", "1", "height that does not move",
                                            -16, 16, 0.5)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F height = implicit_height_at_start(io, ray);
        const vec3<F> eye = normalize(tangent_eye(io));
        const vec2<F> offset =
            vec2<F>(eye) * (height - F(params.reference_plane)) * F(params.height_ratio);
        store_search(io, ray, offset_result(ray, height), ray.uv + offset);
    }
};

}  // namespace quadrel
