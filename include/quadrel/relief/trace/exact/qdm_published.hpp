// qdm@published: quadtree displacement mapping as FlightGear's urban effect has it.
//
// Source: Drobot, "Quadtree Displacement Mapping with Height Blending", GPU Pro, 2010, in
// FlightGear's Shaders/urban.frag (functions ray_intersect and QDM; the variants that go up a level
// are behind "#elseif", which GLSL has not, and never compile). Kept: a node is left half a texel
// times the depth beyond its border; the first crossing divides 0 by 0, and the minimum with NaN
// then goes down to the node's depth whatever the border; at most 64 nodes; the hit is a mean of
// two points two half texels before and behind, weighted by their distances from the surface. The
// listing is for square maps of a power of two. The relief stands on the polygon there: seat 0.
// Not reproduced: its ray. ds is the unit view vector along the fragment's normalised tangent and
// cross(normal, tangent), times a uniform depth_factor over its z; here it is the frame's K, and
// the depth factor the depth in tiles of u. Both are the same on square tiles without shear.
#pragma once

#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// Depths of a map of BakeKind::texel_max, nearest texel, repeated.
template <Number F>
class DepthPyramid {
  public:
    explicit DepthPyramid(const SampledTexture& map) : view_(map.view) {}
    int top() const { return view_.levels - 1; }

    F operator()(const vec2<F>& uv, Int<F> level) const {
        const Int<F> l = min(max(level, Int<F>(0)), Int<F>(top()));
        const Int<F> width = gather_int<F>(view_.width, l), height = gather_int<F>(view_.height, l);
        return F(1) - first_channel<F>(view_, nearest(uv.x, width), nearest(uv.y, height), l);
    }

  private:
    static Int<F> nearest(F u, Int<F> n) {
        return min(to_int(reduce_coordinate(u) * to_float<F>(n)), n - Int<F>(1));
    }
    const TextureView& view_;
};

struct QdmPublished : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"qdm@published", "trace",
                                    "quadtree displacement mapping as listed",
                                    "Drobot 2010; FlightGear urban.frag"};
    static constexpr const char* not_reproduced =
        "ds and depth_factor, of the interpolated tangent and its cross product with the normal: "
        "here K and J of the frame; the channels (.w): the swizzle chooses them";
    static constexpr auto inputs = values(Value::uv, Value::relief_depth, Value::J, Value::K,
                                          Value::frame_status, Value::frame_flags);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::texel_max);
    static constexpr bool needs_height_map = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const DepthPyramid<F> depths(*io.template texture<TextureSlot::texel_max>());
        const F half_texel = F(0.5f) / to_float<F>(Int<F>(height_size(io)));
        const F depth_factor = ray.depth * length(io.template load<Value::J>()[0]);
        const F nudge = half_texel * depth_factor;
        const vec2<F> p = ray.at(F(0)), v = ray.K;
        const vec2<F> ahead = (sign(v) + F(1)) * F(0.5f);
        SearchResult<F> result;
        vec2<F> p2 = p;
        F z(0);
        Int<F> level(depths.top());
        Mask<F> active = ray.active;
        for (const auto it : steps<F>(1, 64)) {
            const F depth = depths(p2, level);
            count_fetch(io.template context<TextureSlot::texel_max>(active));
            count_in<F>(result.steps, active);
            io.march_step(active, z, p2, F(1) - z, F(1) - depth);
            const F cells = power_of_two(to_float<F>(Int<F>(depths.top()) - level));
            const vec2<F> q = p + v * depth, cell = floor(p2 * cells), there = floor(q * cells);
            const Mask<F> crosses = (cell.x != there.x) | (cell.y != there.y);
            const vec2<F> way = p2 - p, border = (cell + ahead) / cells - p;
            const vec2<F> to_border = border * z / way;
            const F next =
                select(crosses, min(depth, min(to_border.x, to_border.y)) + nudge, depth);
            const Mask<F> advances = active & (depth > z);
            p2 = select(advances, p + v * next, p2);
            z = select(advances, next, z);
            level = select(active & !(advances & crosses), level - Int<F>(1), level);
            active = active & (level >= Int<F>(0));
            if (none(active)) break;
        }
        smooth(io, ray, p2 - p, z, half_texel, nudge, active, result);
    }

  private:
    template <class Io>
    static std::int32_t height_size(const Io& io) {
        return io.template texture<TextureSlot::height>()->view.width[0];
    }

    /// The mean of a point before and one behind, and the end of the search.
    template <class Io, class F = typename Io::Number>
    static void smooth(const Io& io, const SearchRay<F>& ray, const vec2<F>& way, F z, F half_texel,
                       F nudge, Mask<F> capped, SearchResult<F>& result) {
        const auto heights = march_heights_of_level(io, F(0));
        const vec2<F> p = ray.at(F(0));
        const F distance = length(way) + nudge;
        const F before = z * (distance - F(2) * half_texel) / distance;
        const F behind = z * (distance + F(2) * half_texel) / distance;
        const vec2<F> a = p + ray.K * before, b = p + ray.K * behind;
        const F error_a = abs(before - (F(1) - heights(ray.active, a)));
        const F height_b = heights(ray.active, b);
        const F error_b = abs(behind - (F(1) - height_b));
        const F t = error_a / (error_a + error_b);
        result.s = mix(before, behind, t);
        result.h = height_b;
        result.fetches = result.steps + select(ray.active, Int<F>(2), Int<F>(0));
        result.status = select(capped, status_packet<F>(Status::cap),
                               search_status<F>(Mask<F>(true), is_nan(result.s)));
        store_search(io, ray, result, mix(a, b, t));
    }
};

}  // namespace quadrel
