// prism-pom: parallax occlusion mapping through a shell: even steps from where a ray enters a
// tetrahedron to where it leaves, then the chord of the last two heights.
//
// Source: C. Dachsbacher, N. Tatarchuk, "Prism Parallax Occlusion Mapping with Accurate Silhouette
// Generation", I3D 2007: entry and exit on the faces of a prism, and a march between both with the
// direction in texture space taken as constant. Corrects it as J. Hirche et al., "Hardware
// Accelerated Per-Pixel Displacement Mapping", 2004, do: in a tetrahedron the direction is constant
// (shell_face.hpp). Steps are as long in all of them, 1 / steps of the shell's depth in the world
// and at most `most`; a tetrahedron has one at least. Where a ray enters is tested, too, and so is
// where it leaves. Misses what is thinner than a step. Exact where heights are linear between two
// samples; a ray that meets nothing is a miss, CLIP, but at the shell's bottom.
#pragma once

#include "quadrel/relief/shell/prism_ray.hpp"
#include "quadrel/relief/trace/search/step_count.hpp"
#include "quadrel/relief/trace/search/tested_heights.hpp"

namespace quadrel {

struct PrismPom : StageDefaults {
    static constexpr StageText text{"prism-pom", "trace",
                                    "even steps through a shell's tetrahedra and one chord",
                                    "after Dachsbacher and Tatarchuk 2007; Hirche et al. 2004"};
    static constexpr auto inputs = values_and(prism_inputs, Value::dUVdx, Value::dUVdy);
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool may_miss = true;
    static constexpr bool reads_vertices = true;

    struct Params {
        std::int32_t steps = 16, most = 64;
    };
    static constexpr std::array parameters{
        parameter<&Params::steps>("steps", "1", "steps over the shell's depth", 1, most_steps, 16),
        parameter<&Params::most>("most", "1", "most steps in a tetrahedron", 1, most_steps, 64)};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const PrismRay<F> ray = prism_ray(io);
        const auto heights = march_heights(io);
        const F wanted = ceil(ray.length / ray.uv.depth * number<F>(params.steps));
        // Of depth 0, NaN: one.
        const F n = select(wanted >= F(1), min(wanted, number<F>(params.most)), F(1));
        // The last sample above the surface and the first at or below it, and how far they are.
        F t_above(0), t_below(1), gap(0), excess(0), height(0);
        Mask<F> active = ray.uv.active, found(false), met_nan(false);
        SearchResult<F> result;
        for (const auto k : steps<F>(0, params.most)) {
            const F index = number<F>(k);
            active = active & (index <= n);
            if (none(active)) break;
            const F t = min(index / n, F(1)), z = ray.height_at(t);
            const vec2<F> uv = ray.uv.at(t);
            const F h = heights(active, uv);
            io.march_step(active, ray.s_at(t), uv, z, h);
            count_in<F>(result.steps, active);
            const Mask<F> floor = ray.ends_below & (index == n) & !is_nan(h);
            const Mask<F> below = active & ((h >= z) | floor), above = active & !below;
            t_below = select(below, t, t_below);
            excess = select(below, max(h - z, F(0)), excess);
            height = select(active, h, height);
            t_above = select(above, t, t_above);
            gap = select(above, z - h, gap);
            met_nan = met_nan | (active & is_nan(h));
            found = found | below;
            active = active & !below;
        }
        const F sum = gap + excess;
        const F part = select((sum > F(0)) & (t_below > F(0)), gap / sum, F(1));
        const F t = min(t_above + (t_below - t_above) * part, t_below);
        result.s = select(found, t, F(1));
        result.h = select(found & (t_below > F(0)), ray.height_at(t), height);
        result.fetches = result.steps;
        result.status = search_status<F>(found, met_nan, Status::clip);
        store_prism(io, ray, result);
    }
};

}  // namespace quadrel
