// shadow-shell: every dual cell that the light ray crosses on its way through a shell, from
// tetrahedron to tetrahedron, its bilinear patch compared exactly.
//
// What shadow-exact is over a plane: that one goes on in the texture space of the hit's own
// tetrahedron, as if the mesh were flat from there on. Each tetrahedron is the affine piece of
// texture space that shell_face.hpp says, and rays pass its faces as shell_walk.hpp says: relief
// anywhere in the shell casts shadows as far as the ray stays in it, around the curve of a mesh and
// across seams of its texture. In the patch where it starts the ray starts on the surface itself,
// and its root there is divided out, as in shadow-exact; later patches are dark where the field is
// above the ray by more than its rounding error, which grows with eye coordinates over the size of
// tetrahedra. Level 0 alone, whatever filters the sampler has; its wrap modes hold.
#pragma once

#include "quadrel/relief/shell/shell_walk.hpp"
#include "quadrel/relief/trace/exact/cell_search.hpp"

namespace quadrel {

struct ShadowShell : StageDefaults {
    static constexpr StageText text{"shadow-shell", "shadow",
                                    "every cell of a shell towards the light, its patch exactly",
                                    "after Hirche et al. 2004; Amanatides and Woo 1987"};
    static constexpr auto inputs = shell_light_inputs;
    static constexpr auto outputs = shadow_outputs;
    static constexpr auto textures = slots(TextureSlot::height);
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;
    static constexpr bool reads_vertices = true;

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> L = to_light(io.template load<Value::hit_P>(), io.frame().lights[io.light()]);
        const SampledTexture& map = *io.template texture<TextureSlot::height>();
        ShellWalk<F> walk(io, L);
        Int<F> points(0);
        if (when(walk.active)) walk.lift(height_over_start(map, walk.part(), walk.active));
        Mask<F> first(true);
        for (const auto k : steps<F>(1, most_shell_cells)) {
            if (none(walk.active)) break;
            const ShellPart<F> part = walk.part();
            Cells<F> cells(part, map, walk.active);
            cells.search(io, map, first);
            points = points + cells.result.steps;
            walk.darken(walk.active & cells.found);
            walk.cross_over(walk.active, part);
            first = Mask<F>(false);
        }
        walk.store(io, points);
    }

  private:
    /// The cells over the part of a ray in one tetrahedron; its parameter runs from 0 to 1 there.
    template <class F>
    struct Cells : CellSearch<F> {
        Grid grid;
        F height, rise, error;
        vec2<F> slack;

        Cells(const ShellPart<F>& part, const SampledTexture& map, Mask<F> lanes)
            : Cells(part, map, cell_grid(map.view.width[0], map.view.height[0], map.sampler),
                    lanes) {}
        Cells(const ShellPart<F>& part, const SampledTexture& map, const Grid& cells, Mask<F> lanes)
            : CellSearch<F>(make_cell_ray(search_ray_of(part, lanes), map, cells, 0.5f), lanes),
              grid(cells),
              height(part.height_at(F(0))),
              rise(-(part.s_rate * part.length)),
              error(part.error),
              slack(part.uv_error.x * texels(map.view.width[0]),
                    part.uv_error.y * texels(map.view.height[0])) {}

        CellHeights<F> heights(const SampledTexture& map) const {
            return cell_heights<F>(map, grid, stored_index<F>(this->i, grid.u),
                                   stored_index<F>(this->j, grid.v));
        }

        template <class Io>
        void search(const Io& io, const SampledTexture& map, Mask<F> starts) {
            for (const auto k : rounds<F>()) {
                this->count_step(1, 2);
                if (none(this->active)) break;
                const CellExit<F> exit = this->exit(this->cell());
                const CellHeights<F> h = heights(map);
                const PatchRay<F> part = this->part_in_cell(exit);
                const F z = height + rise * part.s;
                record(io, this->active, this->ray, part.s, z, h);
                const PatchQuadratic<F> q = patch_quadratic(h, part, z, rise);
                const F tolerance = patch_error(h, part.slack + slack) + error;
                const Mask<F> above = greatest(q, part.length) > tolerance;
                const Mask<F> rises =
                    (part.length > F(0)) & ((q.B > F(0)) | (q.A * part.length + q.B > F(0)));
                const Mask<F> is_dark = (starts & rises) | (above & !starts);
                this->hit(this->active & is_dark, part.s, F(0));
                this->step(this->active, exit);
                starts = Mask<F>(false);
            }
        }

      private:
        static F texels(std::int32_t n) { return F(static_cast<Scalar<F>>(n)); }
    };

    template <class F>
    static SearchRay<F> search_ray_of(const ShellPart<F>& part, Mask<F> active) {
        return {part.uv,  part.uv_rate * part.length, F(1), Scalar<F>(0), active, Int<F>(0),
                Int<F>(0)};
    }

    /// How far the surface is above where the ray starts, at the same texture coordinates.
    template <class F>
    static F height_over_start(const SampledTexture& map, const ShellPart<F>& part,
                               Mask<F> active) {
        const Cells<F> cells(part, map, active);
        const vec2<F> start(cells.ray.x.start - to_float<F>(cells.i),
                            cells.ray.y.start - to_float<F>(cells.j));
        const F surface = patch_height(cells.heights(map), clamp(start, F(0), F(1)));
        return select(is_finite(surface), surface - cells.height, F(0));
    }

    template <class Io, class F>
    static void record(const Io& io, Mask<F> active, const CellRay<F>&, F s, F ray_height,
                       const CellHeights<F>& heights) {
        const SampleContext<F> context = io.template context<TextureSlot::height>(active);
        count_fetch(context);
        io.march_step(active, s, vec2<F>(F(0)), ray_height, heights.h00);
    }
};

}  // namespace quadrel
