// Where a ray, straight or bent by a curved base, first meets the bilinear field: in double, from
// any height, cell by cell.
#pragma once

#include "bake/height_plane.hpp"

namespace quadrel {

/// At fall t the ray is at (x, y) + t (dx, dy), in dual cells (texel centres at whole numbers), and
/// at height z - t + bend t^2.
struct ReliefRay {
    double x, y, dx, dy;
    double z, bend = 0;

    double height(double t) const { return z + (bend * t - 1) * t; }
};

/// The least t >= 0 at which the field is at or above the ray, no later than where that reaches
/// height 0; negative if it leaves through the top (height 1) before. Heights are finite.
double first_meeting(const HeightPlane& plane, const ReliefRay& ray);

}  // namespace quadrel
