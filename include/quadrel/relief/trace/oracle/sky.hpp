// How much of the sky a point of a height field sees, by rays at random.
#pragma once

#include "quadrel/num/vec.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel::oracle {

struct SkyPoint {
    double u, v;          ///< on the field
    double z;             ///< its height, as RayUp has it
    vec3<double> normal;  ///< of the polygon, unit
    vec3<double> Du, Dv;  ///< rows of J times the relief's depth
};

struct Sky {
    double open;   ///< the share of directions, weighted by their cosine, that reach the top
    double error;  ///< standard error of it
};

/// `samples` independent directions, at least 2; equal arguments give equal bits.
Sky open_sky(const Field& field, const SkyPoint& point, int samples, int seed);

}  // namespace quadrel::oracle
