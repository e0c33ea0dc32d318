// offset-limit-rabbid@published: the limited offset of Rabbid76's page, as listed.
//
// Source: Rabbid76 (G. Beier), "Parallax Mapping", graphics-snippets, Parallax() of "Offset
// Limiting" in main() of the general listing:
//     texCoord - parallaxScale * mapHeight * texDir3D.xy,  parallaxScale 0.1, no bias.
// It is not Welsh's with other numbers. texDir3D comes through the inverse of a matrix whose normal
// is multiplied by u_displacement_scale, so that its z is divided by it before it is normalised:
// the smaller the scale, the more of the vector is z and the shorter the shift. For square tiles
// and the angle a between ray and normal, its shift is sin(a) / sqrt(sin(a)^2 + (cos(a) / scale)^2)
// where Welsh's is sin(a): with 0.05, 1/20 at 0, 1/14 at 45, 1/5 at 75, 1/2 at 85 degrees.
//   * The vector is the listing's own (rabbid_direction.hpp): the frame only says whether there is
//     one (its NOFRAME). u_displacement_scale is the number of the material's depth, in units of
//     one tile; below 0.001 nothing is displaced and no height is read.
//   * texture() at the undisplaced coordinate, its height clamped to [0, 1].
//   * Front and back faces alike, as listed.
// The relief's seat moves hit.depth alone. The mapHeight that it returns is hit.h.
#pragma once

#include "quadrel/relief/frame/rabbid_direction.hpp"
#include "quadrel/relief/trace/offset/offset.hpp"
#include "quadrel/relief/trace/search/implicit_height.hpp"

namespace quadrel {

struct OffsetLimitRabbidPublished : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"offset-limit-rabbid@published", "trace",
                                    "Rabbid76's limited offset, along a vector with scaled z",
                                    "Rabbid76, graphics-snippets, Parallax Mapping"};
    static constexpr auto inputs =
        search_inputs_and(Value::P, Value::vertex_normal, Value::dPdx, Value::dPdy);
    static constexpr bool needs_height_map = true;
    struct Params {
        float parallax_scale = 0.1f;
    };
    static constexpr std::array parameters{parameter<&Params::parallax_scale>(
        "parallax_scale", "UV", "length of the longest offset", 0, 16, 0.1)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        if (!rabbid_displaces(io.material())) return store_search(io, ray, on_polygon(ray), ray.uv);
        const vec3<F> texDir3D = rabbid_direction(io).texDir3D;
        const F texel = implicit_height(io, ray.active, ray.uv);
        io.march_step(ray.active, F(ray.s_polygon), ray.uv, F(1) - F(ray.s_polygon), texel);
        const F mapHeight = clamp(texel, F(0), F(1));
        const vec2<F> offset = vec2<F>(texDir3D) * (F(-params.parallax_scale) * mapHeight);
        store_search(io, ray, offset_result(ray, mapHeight), ray.uv + offset);
    }

  private:
    /// vec3( texCoords.st, 0.0 )
    template <class F>
    static SearchResult<F> on_polygon(const SearchRay<F>& ray) {
        SearchResult<F> result;
        result.s = F(ray.s_polygon);
        result.status = status_packet<F>(Status::hit);
        return result;
    }
};

}  // namespace quadrel
