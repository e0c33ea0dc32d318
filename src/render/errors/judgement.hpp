// One hit against the truth, in plain numbers.
#pragma once

#include "quadrel/errors.hpp"
#include "quadrel/relief/trace/oracle/first_hit.hpp"

namespace quadrel {

/// The judge's hit and the ray that it is on.
struct TrueHit {
    oracle::Field field;  ///< of layers, their map as if it were one of heights
    int layers = 0;       ///< how many of these; 0: heights
    oracle::Ray ray;
    Status status = Status::none;
    double s = 0, u = 0, v = 0;
    double cell_x = 0, cell_y = 0, place_x = 0, place_y = 0;  ///< as oracle::Hit has them
    double gradient_u = 0, gradient_v = 0, condition = 0, bound = 0;

    /// On so many of the map's layers; ray, s, u and v are set. Fills in the rest.
    void of_layers(const SampledTexture& map, int count);

    /// Whether there is a truth: a hit, or nothing met, or a hit that is clipped.
    bool is_judged() const {
        return status == Status::hit || status == Status::floor || status == Status::clip;
    }
};

/// What is judged; a NaN in s or u is a value that is not known.
struct FoundHit {
    Status status = Status::none;
    double s = 0, u = 0, v = 0;
};

/// Distance in texels of level 0. Not wrapped: a hit in another tile is as far as that is.
double texels_apart(const TrueHit& truth, const FoundHit& found);

/// Whether the hit is out of the truth's cell by more than 1/256 of a texel.
bool in_other_cell(const TrueHit& truth, const FoundHit& found);

ErrorKind judge_hit(const TrueHit& truth, const FoundHit& found);

}  // namespace quadrel
