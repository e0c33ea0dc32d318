// A search down and up a pyramid of bounds of depth layers: least fronts and greatest backs, pair
// by pair. A node is left in one step where the ray, from where it enters to where it leaves, is
// between all of its solids; any other is gone down into, until a cell has to be tested.
//
// Source: the pyramid of multi-layered relief in K. Oh, H. Ki, C. Lee, "Pyramidal Displacement
// Mapping", VRST 2006, carried on to layers (maxima of odd layers, minima of even ones, in
// heights). What is skipped follows from borders as in height_pyramid.hpp.
#pragma once

#include "quadrel/relief/trace/exact/height_pyramid.hpp"
#include "quadrel/relief/trace/layer/layer_search.hpp"

namespace quadrel {

/// What a ray over [from, to] in s finds of a node's bounds.
template <Number F>
struct NodeSolids {
    Mask<F> clear;  ///< it meets none of them
    F first;        ///< before this s it is in none
};

template <int layers, Number F>
NodeSolids<F> node_solids(const vec4<F>& bounds, F margin, F from, F to) {
    NodeSolids<F> solids{Mask<F>(true), F(2)};
    for (int layer = 0; layer < layers; layer += 2) {
        const F low = bounds[layer] - margin, high = bounds[layer + 1] + margin;
        const Mask<F> passed = from > high;
        solids.clear = solids.clear & (passed | (to < low));
        solids.first = select(passed | (low > solids.first), solids.first, low);
    }
    return solids;
}

/// Searches the cells of `search`; `bounds` is its map of BakeKind::layer_bounds.
template <class Io, int layers, class F = typename Io::Number>
void search_layers(LayerSearch<Io, layers>& search, const SampledTexture& bounds) {
    const HeightPyramid<F> pyramid(bounds, search.grid());
    Int<F> level = pyramid.top();
    for (const auto k : rounds<F>()) {
        search.count_step(16, 4 * pyramid.levels() + 64);
        if (none(search.active)) break;
        const Mask<F> active = search.active;
        const PyramidPlace<F> place = pyramid.place(search, level);
        const CellExit<F> exit = search.exit(place.block);
        const vec4<F> node = all_channels<F>(bounds.view, place.column, place.row, level);
        search.record_node(active, node[0]);
        const NodeSolids<F> solids =
            node_solids<layers>(node, search.ray.margin, search.entry(), min(exit.s, F(1)));
        const Mask<F> finest = level == Int<F>(0), meets = active & !solids.clear;
        const Mask<F> tests = meets & finest, down = meets & !finest;
        if (when(tests)) search.test(tests, exit);
        const Mask<F> crosses = (active & (solids.clear | finest)) & search.active;
        search.leap(crosses, place.block, exit);
        const Mask<F> up = crosses & place.leaves_parent(exit);
        level = select(up, min(level + Int<F>(1), pyramid.top()), level);
        // Into the node, no further than the ray is before the first solid in it.
        search.leap_to(down, min(solids.first, exit.s));
        level = select(down, level - Int<F>(1), level);
    }
}

/// An exact search of the first `layers` of the map.
template <int layers>
struct ExactLayers : StageDefaults {
    static constexpr bool runs_on_duals = true;
    static constexpr bool may_miss = true;
    static constexpr auto inputs = level_0_search_inputs;
    static constexpr auto outputs = trace_outputs;
    static constexpr auto textures = slots(TextureSlot::layers, TextureSlot::layer_bounds);

  protected:
    template <class Io>
    static void search(Io& io) {
        LayerSearch<Io, layers> search(io);
        search_layers(search, *io.template texture<TextureSlot::layer_bounds>());
        search.store();
    }
};

}  // namespace quadrel
