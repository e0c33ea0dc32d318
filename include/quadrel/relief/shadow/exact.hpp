// shadow-exact: every dual cell that the light ray crosses, its bilinear patch compared exactly.
//
// No source's search does this; it is texel-exact upwards. The ray starts on the bilinear surface
// itself at the UV of the hit, wherever the search for the hit stopped. In the patch where it
// starts q(t) = field - ray is 0 at t = 0, so that root is divided out, q / t = A t + B, and no
// bias is needed: dark where that is above 0 anywhere. In later patches dark where q is above its
// rounding error: a ray that only touches is lit. The field is that of level 0, whatever filters
// the sampler has; its wrap modes hold. Lit where a ray crosses more than 2^20 borders, or meets
// only NaN. Where no one counts steps, cells that lie below the ray are left out by a pyramid of
// greatest heights: none of them could be dark.
#pragma once

#include "quadrel/relief/shadow/light_cells.hpp"
#include "quadrel/relief/trace/exact/rising_search.hpp"

namespace quadrel {

/// `Rising` is how it goes on behind the first cell where no one counts; tests plant errors in it.
template <class Rising>
struct ShadowExactBy : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr StageText text{"shadow-exact", "shadow",
                                    "every cell towards the light, its patch exactly",
                                    "after Amanatides and Woo 1987; Ramsey et al. 2004"};
    static constexpr auto inputs = light_ray_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height, TextureSlot::max_mip);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const LightRay<F> light = light_ray(io);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        LightCells<F> search(light, map);
        const auto heights = [&] {
            return cell_heights<F>(map, search.grid, search.stored_i(), search.stored_j());
        };
        CellHeights<F> h = heights();
        const F z = patch_height(h, search.start), rise = F(1) - z;
        search.leave_after(rise);
        const RisingHeight<F> ray{z, rise};
        const auto test = [&](Mask<F> mask, const CellExit<F>& exit, Mask<F> first) {
            const PatchRay<F> part = search.part_in_cell(exit);
            record(io, mask, light.uv + light.K * (part.s * rise), ray.at(part.s), h);
            const auto q = patch_quadratic(h, part, ray.at(part.s), rise);
            const Mask<F> above = greatest(q, part.length) > patch_error(h, part.slack);
            const Mask<F> rises = rises_at_once(q, part.length), later = !first;
            const Mask<F> dark = (first & rises) | (later & above);
            search.hit(mask & dark, part.s, F(0));
        };
        const SampledTexture* const pyramid = io.template texture<TextureSlot::max_mip>();
        search.counts_steps = pyramid == nullptr || are_steps_counted(io);
        Mask<F> first(true);
        for (const auto k : rounds<F>()) {
            search.count_step(1, 2);
            if (none(search.active)) break;
            const CellExit<F> exit = search.exit(search.cell());
            test(search.active, exit, first);
            first = Mask<F>(false);
            search.step(search.active, exit);
            if (!search.counts_steps)
                Rising::run(search, *pyramid, ray, exit.s,
                            [&](Mask<F> mask, const CellExit<F>& next) {
                                h = heights();
                                test(mask, next, first);
                            });
            else
                h = heights();
        }
        store_shadow(io, light, select(search.found, F(0), F(1)), search.result.steps);
    }

  private:
    template <class Io>
    static bool are_steps_counted(const Io& io) {
        const int steps = slot_of(Value::shadow_steps) + io.light();
        return marks_of(io.template context<TextureSlot::height>()) != nullptr ||
               io.call().log != nullptr || io.call().values[steps] != nullptr;
    }

    /// q has the root 0: whether q / t is above 0 in (0, length].
    template <class F>
    static Mask<F> rises_at_once(const PatchQuadratic<F>& q, F length) {
        return (length > F(0)) & ((q.B > F(0)) | (q.A * length + q.B > F(0)));
    }

    template <class Io, class F>
    static void record(Io& io, Mask<F> active, const vec2<F>& uv, F ray_height,
                       const CellHeights<F>& heights) {
        const SampleContext<F> context = io.template context<TextureSlot::height>(active);
        count_fetch(context);
        io.march_step(active, F(1) - ray_height, uv, ray_height, heights.h00);
    }
};

struct ShadowExact : ShadowExactBy<RisingByPyramid> {};

}  // namespace quadrel
