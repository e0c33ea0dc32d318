// Whether rays that climb out of the relief meet it on their way: a search down and up a pyramid of
// greatest heights. In a node a ray is lowest where it enters it; a node below that is left in one
// step. A cell there is not dark by shadow-exact's own test, since what the test computes is less
// than (greatest height - ray's height) + patch_error, and dark is more than patch_error.
#pragma once

#include "quadrel/relief/trace/exact/pyramid_walk.hpp"

namespace quadrel {

/// Of a ray that is at height z + rise s.
template <Number F>
struct RisingHeight {
    F z, rise;
    F at(F s) const { return z + rise * s; }
};

/// The parts are parameters so that tests can plant errors in them.
template <Number F, class Axis, class Levels = PyramidLevels<F>>
class RisingSearch {
  public:
    RisingSearch(CellSearch<F>& search, const SampledTexture& map, const RisingHeight<F>& height)
        : search_(search), map_(map), height_(height) {}

    /// From the cells where the rays are, which they enter at s. `leaf(mask, exit)` tests the cells
    /// where they are then.
    template <class Leaf>
    void run(F s, const Leaf& leaf) {
        PyramidWalk<F, Axis, Levels> walk(search_, map_, Int<F>(0));
        const F margin = search_.ray.margin;
        Mask<F> active = search_.active;
        for (const auto k : rounds<F>()) {
            if (none(active)) break;
            const NodeAround<F> node = walk.node();
            const Mask<F> above = height_.at(s) > node.height + margin;
            const Mask<F> finest = walk.at_cells(), stays = active & !above;
            const Mask<F> down = stays & !finest, tests = stays & finest;
            Mask<F> crosses = active & !(down | Waiting::held(tests));
            if (Waiting::pays(tests, active)) {
                walk.tell(search_);
                search_.active = active;
                leaf(tests, node.exit);
                active = search_.active;
                crosses = crosses | (tests & active);
            }
            s = select(crosses, node.exit.s, s);
            const Mask<F> ends = crosses & (s >= F(1));
            active = active & !ends;
            walk.go_on(node, crosses, down, crosses & !ends, s);
        }
        search_.active = active;
    }

  private:
    CellSearch<F>& search_;
    const SampledTexture& map_;
    RisingHeight<F> height_;
};

/// By the axes that serve the map's grid.
struct RisingByPyramid {
    template <Number F, class Leaf>
    static void run(CellSearch<F>& search, const SampledTexture& map, const RisingHeight<F>& height,
                    F s, const Leaf& leaf) {
        with_axis<F>(search.ray, [&]<class Axis>() {
            RisingSearch<F, Axis>(search, map, height).run(s, leaf);
        });
    }
};

}  // namespace quadrel
