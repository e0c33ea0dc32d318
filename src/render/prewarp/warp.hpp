// Relief textures warped for a view, in two passes of one dimension each.
//
// Source: M. M. Oliveira, G. Bishop, D. McAllister, "Relief Texture Mapping", SIGGRAPH 2000.
// relief/trace/table/prewarp.hpp says what of it was read.
#pragma once

#include <memory>
#include <string>

#include "bake/height_plane.hpp"

namespace quadrel {

/// The eye as a plane sees it: where in texture space it stands above the plane, and how high, in
/// world units; of a parallel projection a direction towards it.
struct EyeOverPlane {
    double u = 0, v = 0, height = 0;
    bool at_infinity = false;
};

/// Texels [first, end) of the plane of texels that goes on beyond the texture.
struct TexelRange {
    int first = 0, end = 0;
    int count() const { return end - first; }
};

struct PrewarpRequest {
    EyeOverPlane eye;
    TexelRange columns, rows;
    double depth = 0;  ///< of the relief, world units
    double seat = 1;   ///< height at which the polygon lies
};

/// The warped image as ReliefPrewarp reads it: what is seen at each texel of the rectangle, of the
/// texels of the rectangle alone. `id` names all that it is made of. Empty where the eye is not
/// above the plane; texels that are not below the eye, or no number, are not there, nor is what
/// lies between them and their neighbours. Runs in parallel; the texels do not depend on that.
std::shared_ptr<const Texture> prewarp(const HeightPlane& heights, const PrewarpRequest& request,
                                       const std::string& id);

}  // namespace quadrel
