// What the rays of a small range have in common: one cell that all of them meet first, or that none
// meets anything. For pixels, whose ray is known to be in a range only.
#pragma once

#include "quadrel/num/range/interval.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel::oracle {

/// What certified.pixel.reason has beside Uncertified's: a pixel's exact ray may hit or miss, or
/// hit either of two cells; or it does not end where the drawn one does. Part of the file format.
inline constexpr Uncertified pixel_open{7}, pixel_apart{8};

/// Every ray with numbers of these ranges; bounded, each as first_hit.hpp has it.
struct RayRange {
    RealInterval u, v;    ///< at s_polygon
    RealInterval Ku, Kv;  ///< shift while s goes from 0 to 1
    double s_polygon;     ///< [0, 1]
};

struct CommonHit {
    /// hit: all rays meet the field first in the cell; floor: none meets it; none: not proven.
    Status status = Status::none;
    double lo = 0, hi = 1;          ///< their s; of a hit
    double cell_x = 0, cell_y = 0;  ///< as Hit has them; of a hit
    Uncertified reason = Uncertified::proven;
};

/// Proven by bounds on double's rounding alone, over all rays at once: what these leave open stays
/// open (pixel_open), and so do rays that lie half a cell or more apart.
CommonHit common_hit(const Field& field, const RayRange& rays);

}  // namespace quadrel::oracle
