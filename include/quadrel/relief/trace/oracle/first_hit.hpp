// Where one ray first meets a height field: computed in double, and proven. The judge of searches;
// not a text over number types, but code of the library for plain numbers, ray by ray.
//
// The field is that of level 0 under the sampler's wrap modes, whatever its filters. A ray is given
// by the numbers of a fragment, taken as they are:
//     (u, v)(s) = (u, v) + (s - s_polygon) (Ku, Kv),  height 1 - s,  s in [0, 1];
// it meets the field at the least s with height(u, v) >= 1 - s. How the proof goes is in
// src/relief/oracle/search.hpp.
#pragma once

#include "quadrel/quad/parameter.hpp"
#include "quadrel/quad/value.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel::oracle {

/// How texels are read as a surface.
enum class Surface : std::int32_t {
    bilinear,  ///< patches between the centres of texels
    block,     ///< texels as boxes; a border belongs to the texel of higher index, as if filtered
               ///< to the nearest
    tri_main,  ///< two triangles between centres, their edge from (i, j) to (i+1, j+1)
    tri_anti,  ///< from (i+1, j) to (i, j+1)
    tri_min,   ///< the one of both whose ends differ less in height; main where equally
};

inline constexpr ValueName surface_names[] = {
    {0, "bilinear"}, {1, "block"}, {2, "tri-main"}, {3, "tri-anti"}, {4, "tri-min"}};

struct Field {
    const SampledTexture* heights;
    const SampledTexture* maxima;  ///< BakeKind::max_mip of them
    Surface surface;
};

struct Ray {
    double u, v;       ///< at s_polygon
    double Ku, Kv;     ///< shift while s goes from 0 to 1
    double s_polygon;  ///< [0, 1]
};

struct Hit {
    double s = 1;
    double u = 0, v = 0;                    ///< there
    double height = 0;                      ///< of the field there
    double cell_x = 0, cell_y = 0;          ///< dual cell, of blocks texel: one of the grid's
    double place_x = 0, place_y = 0;        ///< in the cell, [0, 1]
    double gradient_u = 0, gradient_v = 0;  ///< d height / d(u, v); 0 on blocks
    double condition = 0;                   ///< |ds / d height|; 0 where s is 0, or on a wall
    double bound = 0;                       ///< |s - exact s| is proven to be at most this
    Status status = Status::floor;          ///< hit, floor (met nothing), nan or cap
    Certificate certificate = Certificate::none;
    Uncertified reason = Uncertified::proven;
    std::int32_t steps = 0;  ///< nodes and cells that were looked at
};

/// hit.bound of s rounded to T, itself rounded to T upwards.
template <class T>
T bound_of(const Hit& hit);
extern template float bound_of<float>(const Hit& hit);
extern template double bound_of<double>(const Hit& hit);

/// The first hit of a ray. If `exactly`, by rational arithmetic alone, where the build has it.
Hit first_hit(const Field& field, const Ray& ray, bool exactly = false);

/// Whether the build has rational arithmetic.
bool has_rationals();

/// A ray upwards from a point of the field: (u, v)(t) = (u, v) + t (Ku, Kv), height z + t.
struct RayUp {
    double u, v;
    double Ku, Kv;  ///< shift while it rises by 1
    double z;       ///< height of the point; of all surfaces but blocks, the field's is taken
};

/// Whether the field is above the ray anywhere in t in (0, 1 - z]; touching is not. Decided in
/// double, up to its rounding; `steps` counts nodes and cells.
bool is_occluded(const Field& field, const RayUp& ray, std::int32_t& steps);

}  // namespace quadrel::oracle
