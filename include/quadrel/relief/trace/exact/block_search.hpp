// A search of the field of blocks: each texel a box up to its height, with vertical walls between
// them. Heights are those of the texels of level 0 under the sampler's wrap modes, unfiltered.
#pragma once

#include "quadrel/relief/trace/exact/height_pyramid.hpp"
#include "quadrel/relief/trace/exact/recorded_look_ups.hpp"

namespace quadrel {

template <class Io>
class BlockSearch : public CellSearch<typename Io::Number> {
  public:
    using F = typename Io::Number;

    explicit BlockSearch(const Io& io)
        : BlockSearch(io, search_ray(io), *io.template texture<TextureSlot::height>()) {}

    const Grid& grid() const { return grid_; }

    /// Meets the blocks of the texels where the rays are: their walls, or their tops.
    void test(Mask<F> mask, const CellExit<F>& exit, F height) {
        const F entry = this->entry();
        const F top = F(1) - height, leaves = min(exit.s, F(1));
        // The bottom plane at last, where no block is below it.
        const Mask<F> ends = (exit.s >= F(1)) & (height >= F(0));
        const Mask<F> meets = (height >= F(1) - entry) | (height >= F(1) - leaves) | ends;
        this->met_nan = this->met_nan | (mask & !is_finite(height));
        this->hit(mask & meets & is_finite(height), clamp(top, entry, leaves), height);
    }

    /// The whole search; `ascent` as in search_pyramid.
    void run(int ascent) {
        const HeightPyramid<F> pyramid(*io_.template texture<TextureSlot::texel_max>(), grid_);
        search_pyramid<F>(
            *this, pyramid, ascent,
            [&](Mask<F> mask, const CellExit<F>& exit, F height) { test(mask, exit, height); },
            [&](Mask<F> mask, F height) {
                record_node<TextureSlot::texel_max>(io_, *this, fragment_, mask, height);
            });
        store_cell_search(io_, fragment_, *this);
    }

  private:
    BlockSearch(const Io& io, const SearchRay<F>& fragment, const SampledTexture& map)
        : BlockSearch(io, fragment, map,
                      texel_grid(map.view.width[0], map.view.height[0], map.sampler)) {}
    BlockSearch(const Io& io, const SearchRay<F>& fragment, const SampledTexture& map,
                const Grid& grid)
        : CellSearch<F>(make_cell_ray(fragment, map, grid, 0), fragment.active),
          io_(io),
          fragment_(fragment),
          grid_(grid) {
        this->counts_steps = are_steps_counted(io);
    }

    const Io& io_;
    SearchRay<F> fragment_;
    Grid grid_;
};

}  // namespace quadrel
