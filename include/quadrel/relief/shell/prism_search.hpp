// A search of heights along a ray through a tetrahedron of a shell: its texels' cells, level 0,
// whatever filters the sampler has; its wrap modes hold. Cells that lie below the ray are left by a
// pyramid of greatest heights, from the finest level up, since rays are short.
#pragma once

#include "quadrel/relief/shell/prism_leaf.hpp"
#include "quadrel/relief/shell/prism_ray.hpp"
#include "quadrel/relief/trace/exact/height_pyramid.hpp"

namespace quadrel {

/// In terms of the ray's own parameter t: where a search of heights has s, the depth.
template <class Io>
class PrismSearch : public CellSearch<typename Io::Number> {
  public:
    using F = typename Io::Number;

    PrismSearch(const Io& io, PrismSurface surface)
        : PrismSearch(io, surface, prism_ray(io), *io.template texture<TextureSlot::height>()) {}

    const Grid& grid() const { return grid_; }

    /// Whether the ray, from where it enters its cell, or a node around it, to the exit, is above
    /// `height`, and does not end there with a hit in any case.
    Mask<F> passes(const CellExit<F>& exit, F height) const {
        const F lowest = min(prism_.height_at(this->entry()), prism_.height_at(min(exit.s, F(1))));
        return (lowest > height) & !((exit.s >= F(1)) & prism_.ends_below);
    }
    /// Before this t the ray is above `height`, where it falls; 0 elsewhere.
    F falls_to(F height) const {
        const F start = prism_.height_at(F(0));
        const Mask<F> falls = (prism_.s_shift > F(0)) & (start > height);
        return select(falls, (start - height) / prism_.s_shift, F(0));
    }

    /// Tests the cells where the rays are. Out of line: a search has one copy.
    [[gnu::noinline]] void test(Mask<F> mask, const CellExit<F>& exit) {
        const CellHeights<F> heights = cell_heights<F>(
            map_, grid_, stored_index<F>(this->i, grid_.u), stored_index<F>(this->j, grid_.v));
        PatchRay<F> part = this->part_in_cell(exit);
        const Mask<F> ends_below = part.last & prism_.ends_below;
        record(mask, part, heights);
        const PartHeight<F> height{prism_.height_at(part.s), -prism_.s_shift};
        part.last = ends_below;
        const PatchHit<F> meeting = meet(heights, part, height, ends_below);
        this->met_nan = this->met_nan | (mask & meeting.not_finite);
        this->result.flags = this->result.flags | select(mask & meeting.ambiguous,
                                                         Int<F>(HitFlag::ambiguous), Int<F>(0));
        const F leaves = min(exit.s, F(1));
        this->hit(mask & meeting.hit, min(part.s + meeting.tau, leaves), meeting.height);
    }

    /// Counts a look-up in the pyramid, and tells a probe what it gave.
    void record_node(Mask<F> mask, F height) {
        count_fetch(io_.template context<TextureSlot::max_mip>(mask));
        count_in<F>(this->result.fetches, mask);
        if (io_.call().log == nullptr) return;
        const F t = this->entry();
        io_.march_step(mask, prism_.s_at(t), prism_.uv.at(t), prism_.height_at(t), height);
    }

    /// A ray that meets nothing is a miss.
    void store() {
        SearchResult<F> searched = this->result;
        const Mask<F> unknown = this->met_nan | this->ray.is_nan;
        searched.status = select(this->capped | this->ray.too_long, status_packet<F>(Status::cap),
                                 search_status<F>(this->found, unknown, Status::clip));
        searched.s = select(this->ray.too_long, F(0), searched.s);
        store_prism(io_, prism_, searched);
    }

  private:
    PrismSearch(const Io& io, PrismSurface surface, const PrismRay<F>& prism,
                const SampledTexture& map)
        : PrismSearch(io, surface, prism, map,
                      cell_grid(map.view.width[0], map.view.height[0], map.sampler)) {}
    PrismSearch(const Io& io, PrismSurface surface, const PrismRay<F>& prism,
                const SampledTexture& map, const Grid& grid)
        : CellSearch<F>(make_cell_ray(prism.uv, map, grid, 0.5f), prism.uv.active),
          io_(io),
          surface_(surface),
          prism_(prism),
          map_(map),
          grid_(grid) {}

    PatchHit<F> meet(const CellHeights<F>& heights, const PatchRay<F>& part,
                     const PartHeight<F>& height, Mask<F> ends_below) const {
        if (surface_ == PrismSurface::bilinear)
            return meet_patch(heights, part, height, ends_below, tells_grazes_);
        return meet_triangles(heights, part, height, ends_below, tells_grazes_,
                              surface_ == PrismSurface::tri_main);
    }

    void record(Mask<F> mask, const PatchRay<F>& part, const CellHeights<F>& heights) {
        const SampleContext<F> context = io_.template context<TextureSlot::height>(mask);
        count_fetch(context);
        count_in<F>(this->result.fetches, mask);
        const vec2<F> uv = prism_.uv.at(part.s);
        io_.march_step(mask, prism_.s_at(part.s), uv, prism_.height_at(part.s),
                       patch_height(heights, part.entry));
        if (context.log == nullptr) return;
        log_fetch(context, map_, uv, lod_from_level(map_, F(0)),
                  vec4<F>(heights.h00, heights.h10, heights.h01, heights.h11));
    }

    const Io& io_;
    PrismSurface surface_;
    PrismRay<F> prism_;
    const SampledTexture& map_;
    Grid grid_;
    bool tells_grazes_ = io_.template wanted<Value::hit_flags>();
};

/// Searches the cells of `search`; `maxima` is its map of BakeKind::max_mip.
template <class Io, class F = typename Io::Number>
void search_prism(PrismSearch<Io>& search, const SampledTexture& maxima) {
    descend_pyramid<F>(
        search, HeightPyramid<F>(maxima, search.grid()), Int<F>(0), search, -1,
        [&](Mask<F> mask, const CellExit<F>& exit, F) { search.test(mask, exit); },
        [&](Mask<F> mask, F height) { search.record_node(mask, height); });
}

}  // namespace quadrel
