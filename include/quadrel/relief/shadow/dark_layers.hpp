// Whether a part of a light's ray is inside of the solids of a cell, as the exact shadows of layers
// have it. A ray starts on one of the layers: in the patch where it starts that layer's quadratic
// is 0 at t = 0, and the root is divided out, so that no bias is needed.
#pragma once

#include "quadrel/relief/trace/layer/layer_search.hpp"

namespace quadrel {

/// A light ray's own layer: the one that it starts on.
template <Number F>
struct StartLayer {
    F depth;
    F distance;  ///< from the hit's depth
    Mask<F> is_own[4];
};

/// The layer next to s where the ray starts.
template <Number F>
StartLayer<F> start_layer(const CellLayers<F>& cell, const vec2<F>& at, F s) {
    const Mask<F> no(false);
    const F never(std::numeric_limits<Scalar<F>>::infinity());
    StartLayer<F> start{F(0), never, {no, no, no, no}};
    for (int layer = 0; layer < 4; ++layer) {
        const F depth = patch_height(cell.layer[layer], at), distance = abs(depth - s);
        const Mask<F> nearer = distance < start.distance;
        for (int other = 0; other < 4; ++other) start.is_own[other] = start.is_own[other] & !nearer;
        start.is_own[layer] = nearer;
        start.depth = select(nearer, depth, start.depth);
        start.distance = select(nearer, distance, start.distance);
    }
    return start;
}

/// Whether a ray that starts on one side of a solid, where `own` is 0 without its rounding error,
/// is inside of it in the part.
template <Number F>
Mask<F> enters_own_solid(const SolidQuadratics<F>& solid, const PatchQuadratic<F>& own,
                         const PatchQuadratic<F>& other, F length) {
    const F again = -own.B / own.A;
    const Mask<F> returns = (own.A > F(0)) & (again > F(0)) & (again <= length);
    const Mask<F> at_once = (own.B > F(0)) & (other.C > F(0));
    const auto across = upward_crossing(solid, other, length);
    return (length > F(0)) & (at_once | (returns & (solid.thickness(again) > F(0))) |
                              (across.enters & (across.tau > F(0))));
}

/// `first`: it is the part where the ray starts. Of the solid that it starts on, dark where it is
/// inside right away or comes into it again; of all others where it is inside by more than the
/// rounding error on either side: a ray that only touches is lit.
template <Number F>
Mask<F> is_dark(const CellLayers<F>& cell, const PatchRay<F>& part, const RayDepth<F>& ray,
                Mask<F> first, const StartLayer<F>& start) {
    Mask<F> dark(false);
    for (int layer = 0; layer < 4; layer += 2) {
        const CellHeights<F>&front = cell.layer[layer], &back = cell.layer[layer + 1];
        const SolidQuadratics<F> solid = solid_quadratics(front, back, part, ray);
        const F error = solid_error(front, back, part.slack);
        const Mask<F> from_front = first & start.is_own[layer];
        const Mask<F> from_back = first & start.is_own[layer + 1];
        const Mask<F> inside = enter_solid(inset(solid, error), part.length).hit;
        const Mask<F> of_front = enters_own_solid(solid, solid.below, solid.above, part.length);
        const Mask<F> of_back = enters_own_solid(solid, solid.above, solid.below, part.length);
        const Mask<F> own = (from_front & of_front) | (from_back & of_back);
        dark = dark | own | (inside & !(from_front | from_back));
    }
    return dark;
}

}  // namespace quadrel
