// How far a search's hits are from the true first ones.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel::sweep {

/// What became of one pixel's ray.
enum class RayEnd : std::uint8_t {
    none,         ///< not covered, or without a ray
    same,         ///< within the tolerance of the true hit
    late,         ///< beyond it
    early,        ///< before it
    hit_of_miss,  ///< a hit, where the ray meets nothing
    miss_of_hit,  ///< none, where it meets the surface
    nan           ///< the search ended at a NaN, or its hit is none
};

/// Percentiles of a distance that is never negative.
struct Percentiles {
    double median = 0, p90 = 0, p99 = 0, most = 0, mean = 0;
    /// Any other, of 0 to 100.
    double at(double percent) const;
    std::vector<float> sorted;
};

/// Pixel by pixel, and as a whole.
struct RunError {
    std::uint64_t rays = 0;
    Percentiles s;       ///< |s - true s|, in thicknesses of the relief
    Percentiles texels;  ///< distance from the true hit in the plane of the map, in texels
    /// Shares of the rays.
    double late = 0, early = 0, hit_of_miss = 0, miss_of_hit = 0, nan = 0;
    double wrong() const { return late + early + hit_of_miss + miss_of_hit + nan; }
    std::vector<float> map;  ///< by pixel: texels, negative before the true hit; NaN without a ray
    std::vector<RayEnd> ends;  ///< by pixel
};

/// The channels that `run_error` needs of the run and of the truth, which is the same scene with
/// the judge's trace.
std::vector<std::string> error_channels();

/// `width` and `height`: of the height map, texels. `tolerance`: in texels.
RunError run_error(const Film& run, const Film& truth, int width, int height, double tolerance);

}  // namespace quadrel::sweep
