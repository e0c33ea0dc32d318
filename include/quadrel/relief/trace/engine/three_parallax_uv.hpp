// three-parallax-uv: parallaxUV of the shading language of three.js.
//
// Source: three.js, src/nodes/accessors/AccessorsUtils.js at 085048b0, parallaxUV(uv, scale) =
// uv - parallaxDirection * scale: the unit view vector along tangent, bitangent and normal, left
// unnormalised, and not divided by its z. What the scale is is the user's business; here, as in the
// example webgpu_parallax_uv.html with its factor of 0.3, a length times a map of depths, read as
// 1 - height with implicit derivatives. (The example takes its u from red and its v
// from green; here both are channel 0.) The relief's depth and seat move hit.depth alone.
#pragma once

#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/tangent_viewer.hpp"

namespace quadrel {

struct ThreeParallaxUv : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"three-parallax-uv", "trace", "parallaxUV of three.js' TSL",
                                    "three.js, src/nodes/accessors/AccessorsUtils.js"};
    // Implicit derivatives are those of the coordinates: dUVdx and dUVdy are not asked for.
    static constexpr auto inputs = tangent_search_inputs;
    static constexpr const char* not_reproduced =
        "the example's map, whose red moves u and whose green moves v: here both are channel "
        "0";
    struct Params {
        float scale = 0.3f;
    };
    static constexpr std::array parameters{
        parameter<&Params::scale>("scale", "UV", "UV length of the depth range", -16, 16, 0.3)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F height = implicit_height_at_start(io, ray);
        const vec2<F> direction(tangent_viewer(io));
        const F scale = F(params.scale) * (F(1) - height);
        store_search(io, ray, offset_result(ray, height), ray.uv - direction * scale);
    }
};

}  // namespace quadrel
