// vdm: a view-dependent displacement map, which has the distance to the relief along every
// direction from every point of its top, and for bases of several curvatures: one look-up, and no
// search.
//
// Source: L. Wang, X. Wang, X. Tong, S. Lin, S. Hu, B. Guo, H.-Y. Shum, "View-Dependent
// Displacement Mapping", SIGGRAPH 2003: d(x, y, theta, phi, c), c the curvature of the base along
// the viewing direction; the point that is seen is that at distance d, and where the map says -1
// the ray passes by the silhouette: CLIP here. The source compresses its map by singular values;
// here it is plain, linear in place, direction and curvature. Directions and distances are those of
// gdm. The curvature is that of the frame's normal over the quad: the source takes it from the
// mesh. hit.s is the depth below the curved top. Early and late: what is interpolated between a
// near and a far surface is at neither.
#pragma once

#include "quadrel/relief/trace/table/distance_table.hpp"

namespace quadrel {

/// How much higher than over a plane a ray is, over the curved base: in units of the relief's
/// depth, once it has fallen by s, bend * s^2. By the differences of position, UV and normal over
/// the quad; 0 where UV has no area.
template <class Io, class F = typename Io::Number>
F bend_of_base(const Io& io) {
    const vec3<F> px = io.template load<Value::dPdx>(), py = io.template load<Value::dPdy>();
    const vec2<F> qx = io.template load<Value::dUVdx>(), qy = io.template load<Value::dUVdy>();
    const vec2<F> rate = io.template load<Value::uv_rate>();
    const vec3<F> N = io.template load<Value::frame_normal>();
    const auto derivatives = io.frame().derivatives;
    // Pixels in x and y in which UV shifts as along the ray for a depth of 1.
    const F area = qx.x * qy.y - qx.y * qy.x;
    const F along_x = (rate.x * qy.y - rate.y * qy.x) / area;
    const F along_y = (qx.x * rate.y - qx.y * rate.x) / area;
    const vec3<F> way = px * along_x + py * along_y;
    const vec3<F> turn = dFdx(N, derivatives) * along_x + dFdy(N, derivatives) * along_y;
    const F bend = F(0.5f) * io.template load<Value::relief_depth>() * dot(turn, way);
    return select(is_finite(bend), bend, F(0));
}

struct Vdm : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"vdm", "trace", "one look-up of the distance along the view",
                                    "Wang et al. 2003, View-Dependent Displacement Mapping"};
    static constexpr auto inputs = values(
        Value::uv, Value::relief_depth, Value::K, Value::frame_status, Value::frame_flags,
        Value::frame_normal, Value::uv_rate, Value::dPdx, Value::dPdy, Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::vdm);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const DistanceTable<TextureSlot::vdm, Io> distances(io, ray.K);
        const DirectionTable<F>& table = distances.table();
        // Of a table that has curvatures from -most to most; of one that has none, 0.
        const F most = table.curvature(), square = dot(ray.K, ray.K);
        const F to_bend = F(0.5f) * square / table.depth();
        const Mask<F> bends = (most > F(0)) & (to_bend > F(0));
        const F curvature = select(bends, clamp(bend_of_base(io) / to_bend, -most, most), F(0));
        const F last(static_cast<Scalar<F>>(table.slices() - 1));
        const F layer = select(bends, (curvature / most + F(1)) * F(0.5f) * last, F(0.5f) * last);
        const vec2<F> top = ray.at(F(0));
        const F fall = distances.fall(ray.active, top, layer);
        const F s = fall - curvature * to_bend * fall * fall;
        io.march_step(ray.active, F(0), top, F(1), F(1) - s);
        const Mask<F> finite = is_finite(top.x + top.y) & is_finite(ray.K.x + ray.K.y);
        const Mask<F> broken = is_nan(fall) | !finite, passes = fall < F(0);
        SearchResult<F> result;
        result.s = select(passes, F(0), clamp(s, F(0), F(1)));
        result.h = F(1) - result.s;
        result.status =
            select(broken, status_packet<F>(Status::nan),
                   select(passes, status_packet<F>(Status::clip), status_packet<F>(Status::hit)));
        result.steps = select(ray.active, Int<F>(1), Int<F>(0));
        result.fetches = select(ray.active, Int<F>(distances.fetches), Int<F>(0));
        store_search(io, ray, result, top + ray.K * select(passes, F(0), fall));
    }
};

}  // namespace quadrel
