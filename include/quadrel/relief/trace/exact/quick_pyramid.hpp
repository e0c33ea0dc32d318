// The search down and up a pyramid where no one counts its steps: it begins at a level that suits
// the ray's length, and lanes that have come to a cell wait there until testing pays. Which cells
// are tested, in which order, is the same for every ray: those that do not lie below it, on the way
// to its hit.
#pragma once

#include "quadrel/relief/trace/exact/pyramid_walk.hpp"

namespace quadrel {

/// Nodes of which a ray that goes through the whole relief crosses four to eight.
template <Number F>
Int<F> level_of_length(const CellRay<F>& ray) {
    const F cells = max(max(abs(ray.x.rate), abs(ray.y.rate)), F(1));
    return max(to_int_in_range(exponent(cells)) - Int<F>(2), Int<F>(0));
}

/// The parts are parameters so that tests can plant errors in them.
template <Number F, class Axis, class Levels = PyramidLevels<F>, class Wait = Waiting>
class QuickPyramidSearch {
  public:
    QuickPyramidSearch(CellSearch<F>& search, const SampledTexture& map)
        : search_(search), map_(map) {}

    /// `leaf(mask, exit, height)` tests the cells where the rays are.
    template <class Leaf>
    void run(const Leaf& leaf) {
        PyramidWalk<F, Axis, Levels> walk(search_, map_, level_of_length(search_.ray));
        const F margin = search_.ray.margin;
        Mask<F> active = search_.active;
        for (const auto k : rounds<F>()) {
            if (none(active)) break;
            const NodeAround<F> node = walk.node();
            const F bound = node.height + margin;
            const Mask<F> above = F(1) - min(node.exit.s, F(1)) > bound;
            const Mask<F> finest = walk.at_cells(), stays = active & !above;
            const Mask<F> down = stays & !finest, tests = stays & finest;
            Mask<F> crosses = active & !(down | Wait::held(tests));
            if (Wait::pays(tests, search_.tests_are_costly ? active : tests)) {
                walk.tell(search_);
                search_.active = active;
                leaf(tests, node.exit, node.height);
                active = search_.active;
                crosses = crosses | (tests & active);
            }
            // Into the node, no further than the ray is above all of it.
            const F s = select(down, min(F(1) - bound, node.exit.s), node.exit.s);
            const Mask<F> goes = crosses | (down & (s > F(0))), ends = goes & (s >= F(1));
            active = active & !ends;
            walk.go_on(node, crosses, down, goes & !ends, s);
        }
        search_.active = active;
    }

  private:
    CellSearch<F>& search_;
    const SampledTexture& map_;
};

/// Finds what search_pyramid finds.
template <Number F, class Leaf>
void search_pyramid_quickly(CellSearch<F>& search, const SampledTexture& map, const Leaf& leaf) {
    with_axis<F>(search.ray,
                 [&]<class Axis>() { QuickPyramidSearch<F, Axis>(search, map).run(leaf); });
}

}  // namespace quadrel
