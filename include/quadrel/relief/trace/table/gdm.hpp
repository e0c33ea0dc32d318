// gdm: a generalized displacement map, which has the distance to the relief along every direction
// from every point of its volume. The base is divided into prisms; where the ray enters one, the
// distance is looked up, and if it is no longer than the way to where the ray leaves, there is the
// hit, else the next prism is asked.
//
// Source: X. Wang, X. Tong, S. Lin, S. Hu, B. Guo, H.-Y. Shum, "Generalized Displacement Maps",
// Eurographics Symposium on Rendering 2004. There prisms are extruded from a mesh's triangles, and
// rasterized; here the base is a plane, its prisms are boxes of equal squares of a tile, and one
// fragment goes from one to the next. The source compresses its map by singular values; here it is
// plain, linear in place, height and direction, which are nodes of direction_table.hpp in the place
// of spherical coordinates. Distances are counted in the ray's way from top to bottom: a plane's
// are then equal in all directions, and in between as well. Early and late: what is interpolated
// between a near and a far surface is at neither.
#pragma once

#include "quadrel/relief/trace/table/distance_table.hpp"

namespace quadrel {

/// Where rays leave boxes of a part of a tile, one axis of them.
template <Number F>
struct PrismAxis {
    F start, rate;  ///< in boxes, at s = 0 and per unit of s
    F box;          ///< where the ray is

    PrismAxis(F u, F K, F boxes) : start(u * boxes), rate(K * boxes), box(floor(start)) {}

    F exit() const {
        const F ahead = select(rate > F(0), box + F(1), box);
        const F never(std::numeric_limits<Scalar<F>>::infinity());
        return select(rate == F(0), never, (ahead - start) / rate);
    }
    void step(Mask<F> mask) { box = select(mask, box + select(rate > F(0), F(1), F(-1)), box); }
};

struct Gdm : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"gdm", "trace",
                                    "distances along rays from where they enter prisms",
                                    "Wang et al. 2004, Generalized Displacement Maps"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::gdm);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;
    struct Params {
        std::int32_t prisms = 4;
        std::int32_t steps = 1024;
    };
    static constexpr std::array parameters{
        parameter<&Params::prisms>("prisms", "1/tile", "prisms along a side of a tile", 1, 1024, 4),
        parameter<&Params::steps>("steps", "1", "prisms at most", 1, 65536, 1024)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const DistanceTable<TextureSlot::gdm, Io> distances(io, ray.K);
        const F slices(static_cast<Scalar<F>>(distances.table().slices()));
        const vec2<F> top = ray.at(F(0));
        const F boxes = number<F>(params.prisms);
        PrismAxis<F> x(top.x, ray.K.x, boxes), y(top.y, ray.K.y, boxes);
        SearchResult<F> result;
        const Mask<F> finite = is_finite(top.x + top.y) & is_finite(ray.K.x + ray.K.y);
        Mask<F> active = ray.active & finite, found(false), met_nan = ray.active & !finite;
        Mask<F> at_bottom(false);
        F s(0);
        for (const auto k : steps<F>(1, params.steps)) {
            const vec2<F> uv = ray.at(s);
            const F z = F(1) - s;
            // Below the lowest nodes distances shrink to 0 at the bottom.
            const F fall = distances.fall(active, uv, z * slices - F(1)) * min(z * slices, F(1));
            io.march_step(active, s, uv, z, z - fall);
            count_in<F>(result.steps, active);
            const F exit_x = x.exit(), exit_y = y.exit(), exit = min(exit_x, exit_y);
            met_nan = met_nan | (active & is_nan(fall));
            const Mask<F> hits = active & (s + fall <= min(exit, F(1)));
            result.s = select(hits, s + fall, result.s);
            found = found | hits;
            active = active & !hits & !is_nan(fall);
            at_bottom = at_bottom | (active & (exit >= F(1)));
            active = active & !at_bottom;
            if (none(active)) break;
            s = select(active, exit, s);
            x.step(active & (exit_x <= exit_y));
            y.step(active & !(exit_x <= exit_y));
        }
        result.s = select(active, s, result.s);
        result.h = F(1) - result.s;
        result.status = select(at_bottom, status_packet<F>(Status::floor),
                               search_status<F>(found, met_nan, Status::cap));
        result.fetches = result.steps * Int<F>(distances.fetches);
        store_search(io, ray, result);
    }
};

}  // namespace quadrel
