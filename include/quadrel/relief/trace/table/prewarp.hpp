// relief-prewarp: the relief texture, warped for the view, is mapped on the polygon like any other;
// no ray is searched.
//
// Source: M. M. Oliveira, G. Bishop, D. McAllister, "Relief Texture Mapping", SIGGRAPH 2000. Of it
// and of the dissertation of that name the abstracts were read; equations and passes are those that
// literature after it reports, derived anew: a texel (u, v) that is q above the polygon is seen
// through
//     ((u + k1 q) / (1 + k3 q), (v + k2 q) / (1 + k3 q)),
// k1, k2, k3 of the view. Rows are warped first, then columns, each towards the epipole, so that
// what is nearer comes later; between two texels all that a texel has is linear
// (render/prewarp/warp.hpp). Differs: what is warped is where a texel comes from and how deep it
// lies, not its colour, so that every map follows; texels next to each other in the warped image
// are blended as colours would be, and where one has nothing the others count alone, and where most
// of the weight has nothing there is nothing: CLIP.
//
// One plane with one affine UV a material, whose warp covers the rectangle of texture space that
// its polygons do: a texel outside is not there, whatever wraps. Late and early: what is between
// two surfaces is at neither, and of texels that the first pass puts in one place one is left,
// though the second would part them.
#pragma once

#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel {

/// A texel of a warped image holds u, v, s and whether there is anything. The last row is not of
/// the image: it begins with the least u and v of the rectangle, and one over its sides.
struct ReliefPrewarp : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr StageText text{"relief-prewarp", "trace",
                                    "one look-up in the relief texture as warped for the view",
                                    "Oliveira, Bishop and McAllister 2000, Relief Texture Mapping"};
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::prewarp);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const SearchRay<F> ray = search_ray(io);
        const SampledTexture& map = *io.template texture<TextureSlot::prewarp>();
        count_fetch(io.template context<TextureSlot::prewarp>(ray.active));
        const vec2<F> texels = TexelSize<F>(map).texels;
        const F rows = texels.y - F(1);
        const vec4<F> area = all_channels<F>(map.view, Int<F>(0), to_int(rows), Int<F>(0));
        const Axis<F> x((ray.uv.x - area.x) * area.z, texels.x);
        const Axis<F> y((ray.uv.y - area.y) * area.w, rows);
        vec3<F> sum(F(0));
        F weight(0);
        const auto tap = [&](Int<F> column, Int<F> row, F share) {
            const vec4<F> texel = all_channels<F>(map.view, column, row, Int<F>(0));
            const F counts = texel.w * share;
            sum = sum + vec3<F>(texel.x, texel.y, texel.z) * counts;
            weight = weight + counts;
        };
        tap(x.low, y.low, (F(1) - x.part) * (F(1) - y.part));
        tap(x.high, y.low, x.part * (F(1) - y.part));
        tap(x.low, y.high, (F(1) - x.part) * y.part);
        tap(x.high, y.high, x.part * y.part);
        const Mask<F> finite = is_finite(ray.uv.x + ray.uv.y);
        const Mask<F> found = weight >= F(0.5f);
        const vec3<F> mean = sum / select(found, weight, F(1));
        SearchResult<F> result;
        result.s = select(found, clamp(mean.z, F(0), F(1)), F(ray.s_polygon));
        result.h = F(1) - result.s;
        result.status = search_status<F>(found, !finite, Status::clip);
        result.steps = select(ray.active, Int<F>(1), Int<F>(0));
        result.fetches = result.steps;
        const vec2<F> uv = select(found, vec2<F>(mean.x, mean.y), ray.uv);
        io.march_step(ray.active, result.s, uv, result.h, result.h);
        store_search(io, ray, result, uv);
    }

  private:
    /// Two neighbouring texels of an axis; the outermost one beyond the middle of that.
    template <Number F>
    struct Axis {
        Int<F> low, high;
        F part;

        Axis(F at, F texels) {
            const F last = texels - F(1), place = at * texels - F(0.5f);
            const F inside = select(is_nan(place), F(0), clamp(place, F(0), last));
            const F first = floor(inside);
            low = to_int(first);
            high = to_int(min(first + F(1), last));
            part = inside - first;
        }
    };
};

}  // namespace quadrel
