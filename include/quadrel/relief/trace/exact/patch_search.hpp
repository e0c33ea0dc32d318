// A search of the bilinear field of level 0 over its dual cells. Heights are those of the texels,
// whatever filters the sampler has; its wrap modes hold.
#pragma once

#include "quadrel/relief/trace/exact/recorded_look_ups.hpp"

namespace quadrel {

/// A row of such a search; those that read a baked map, too, name both.
struct PatchTrace : HeightSearch {
    static constexpr bool runs_on_duals = true;
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr bool needs_height_map = true;
    static constexpr bool reads_finest_heights_only = true;
};

template <class Io>
class PatchSearch : public CellSearch<typename Io::Number> {
  public:
    using F = typename Io::Number;

    explicit PatchSearch(const Io& io)
        : PatchSearch(io, search_ray(io), *io.template texture<TextureSlot::height>()) {}

    const Grid& grid() const { return grid_; }
    const SampledTexture& map() const { return map_; }
    /// The rays as fragments have them.
    const SearchRay<F>& fragment() const { return fragment_; }

    /// Stored indices of the cells where the rays are.
    Int<F> stored_i() const { return stored_index<F>(this->i, grid_.u); }
    Int<F> stored_j() const { return stored_index<F>(this->j, grid_.v); }

    /// Tests the patches of the cells where the rays are. Out of line: a search has one copy.
    [[gnu::noinline]] void test(Mask<F> mask, const CellExit<F>& exit) {
        const CellHeights<F> heights = cell_heights<F>(map_, grid_, stored_i(), stored_j());
        const PatchRay<F> part = this->part_in_cell(exit);
        const PatchHit<F> meeting = intersect_patch(heights, part, tells_grazes_);
        record_cell<TextureSlot::height>(io_, *this, fragment_, map_, mask, part.s, heights,
                                         patch_height(heights, part.entry));
        this->met_nan = this->met_nan | (mask & meeting.not_finite);
        this->result.flags = this->result.flags | select(mask & meeting.ambiguous,
                                                         Int<F>(HitFlag::ambiguous), Int<F>(0));
        const F leaves = min(exit.s, F(1));
        this->hit(mask & meeting.hit, min(part.s + meeting.tau, leaves), meeting.height);
    }

    /// Counts look-ups in a map that was baked for this search, and tells a probe what they gave.
    template <TextureSlot slot, int fetches = 1>
    void record_node(Mask<F> mask, F height) {
        quadrel::record_node<slot, fetches>(io_, *this, fragment_, mask, height);
    }

    void store() { store_cell_search(io_, fragment_, *this); }

  private:
    PatchSearch(const Io& io, const SearchRay<F>& fragment, const SampledTexture& map)
        : PatchSearch(io, fragment, map,
                      cell_grid(map.view.width[0], map.view.height[0], map.sampler)) {}
    PatchSearch(const Io& io, const SearchRay<F>& fragment, const SampledTexture& map,
                const Grid& grid)
        : CellSearch<F>(make_cell_ray(fragment, map, grid, 0.5f), fragment.active),
          io_(io),
          fragment_(fragment),
          map_(map),
          grid_(grid) {
        this->counts_steps = are_steps_counted(io);
        this->tests_are_costly = true;
    }

    const Io& io_;
    SearchRay<F> fragment_;
    const SampledTexture& map_;
    Grid grid_;
    bool tells_grazes_ = io_.template wanted<Value::hit_flags>();
};

}  // namespace quadrel
