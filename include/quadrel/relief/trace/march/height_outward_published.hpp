// height-outward@published: FlightGear's height mapping as listed.
//
// Source: T. Renk, FlightGear wiki, "Howto: Shader programming in FlightGear", relief maps (2016),
// function height_coord_shift. (The page lost its braces: the loop's body is the fetch, the test
// that breaks, and the step.) Kept:
//   * the march starts 0.6 vertical scales of ray length above the polygon, so that anything higher
//     than 0.6 N.V is cut off and found at the first point;
//   * points are accumulated; the test is strict; a ray that finds nothing ends on the polygon but
//     for rounding, and is FLOOR;
//   * positions are divided by relief_hresolution on their way to the map although the caller hands
//     in texture coordinates: at the default 1 there is one unit;
//   * texture2D in the loop takes implicit derivatives: lanes that left keep their last coordinate.
// relPos is a varying, from the eye to the point. The page's surface lies in the model's xy plane,
// whose coordinates are those of the map, and leaves the general case to tangent space: here it is
// taken along the vertices' tangent, binormal and normal and interpolated (vertex_frame.hpp), which
// is the same for the page's surface.
// The relief stands on the polygon whatever the material's seat, and vscale is a length in texture
// coordinates; depth and seat move hit.depth alone. The height is channel 0.
#pragma once

#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"
#include "quadrel/relief/vertex_frame.hpp"

namespace quadrel {

struct HeightOutwardPublished : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"height-outward@published", "trace",
                                    "outside-in sampling above the polygon as listed",
                                    "Renk, FlightGear wiki, relief maps, 2016"};
    static constexpr const char* not_reproduced =
        "the channel (.a): the height map's swizzle chooses it; relPos beyond the model's xy plane "
        "is left open by the page, here: along the vertices' axes";
    static constexpr auto inputs = search_inputs;
    static constexpr bool reads_vertices = true;
    static constexpr bool needs_height_map = true;
    struct Params {
        float vscale = 0.1f, hresolution = 1;
        std::int32_t points = 50;
    };
    static constexpr std::array parameters{
        parameter<&Params::vscale>("vscale", "UV", "height of the relief", 0x1p-20, 16, 0.1),
        parameter<&Params::hresolution>("hresolution", "UV", "length of the map", 0x1p-20, 0x1p20,
                                        1),
        parameter<&Params::points>("points", "1", "points of the march", 1, 65536, 50)};
    static constexpr bool uses_height_bounds = true;
    static std::int32_t lattice_steps(const Params& params) { return params.points; }

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const F npoints(static_cast<Scalar<F>>(params.points)), vscale(params.vscale);
        const vec3<F> nRay = normalize(-vertex_eye(io));
        const F sampling_resolution = vscale / npoints * F(0.6f);
        const vec3<F> vRay = nRay * -sampling_resolution;
        vec3<F> pos = vec3<F>(ray.uv, F(0)) + vRay * npoints;

        SearchResult<F> result;
        Mask<F> active = ray.active, met_nan(false);
        const ImplicitHeights heights(io);
        const Course course{
            [&](const vec3<F>& from) { return vec2<F>(from) / F(params.hresolution); },
            [&](const vec3<F>& from, F texel) { return !(vscale * texel > from.z); },
            [&](const vec3<F>& from) { return from - vRay; }};
        for (const auto k : steps_on_course<F>(course, pos, heights, active, 1, params.points)) {
            const vec2<F> at = course.at(pos);
            const F texel = heights(active, at);
            io.march_step(active, F(1) - pos.z / vscale, at, pos.z / vscale, texel);
            result.h = select(active, texel, result.h);
            count_in<F>(result.steps, active);
            met_nan = met_nan | (active & is_nan(texel));
            active = active & course.passes(pos, texel);
            pos = select(active, course.next(pos), pos);
            if (none(active)) break;
        }
        result.s = F(1) - pos.z / vscale;
        result.status = search_status<F>(!active, met_nan);
        result.fetches = result.steps;
        store_search(io, ray, result, ray.uv + (vec2<F>(pos) - ray.uv));
    }
};

}  // namespace quadrel
