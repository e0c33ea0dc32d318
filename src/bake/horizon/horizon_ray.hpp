// The steepest sight line from a texel along one azimuth.
#pragma once

#include "bake/height_plane.hpp"

namespace quadrel {

struct HorizonRay {
    int i, j;                 ///< the texel whose centre it starts from
    double along_u, along_v;  ///< texels per tile unit of length
    double length;            ///< tile units
};

/// The supremum of (h(t) - h(0)) / t over the bilinear field, 0 < t <= length, and 0. Nodes of the
/// plane's max-mip pyramid over `cells` that are below the sight line so far are passed at once.
double exact_horizon(const HeightPlane& plane, const Grid& cells, const Texture& pyramid,
                     const HorizonRay& ray);

/// The same over the nearest texels at whole texel steps along the ray's longer axis. `top` is the
/// greatest height of the plane.
double sampled_horizon(const HeightPlane& plane, const HorizonRay& ray, double top);

}  // namespace quadrel
