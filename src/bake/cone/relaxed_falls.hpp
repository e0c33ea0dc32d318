// How steeply a field of depths falls behind each texel: what rays that go down more steeply cannot
// come out of. It does not depend on where a ray comes from.
#pragma once

#include <array>
#include <vector>

#include "bake/cone/relaxed_rays.hpp"
#include "bake/search/plane_tree.hpp"

namespace quadrel {

/// What float32 may be off by along a ray. Inside of a cone all is within 4 tiles of texel 0, where
/// a rounding is up to 2^-23.
struct RayErrors {
    RayErrors(const HeightPlane& plane, int steps)
        : start(std::max(plane.width, plane.height) * 0x1p-21),
          samples(std::max(plane.width, plane.height) * (steps + 8) * 0x1p-22),
          depth(steps * 0x1p-24) {}

    double start;    ///< texels, of where it enters
    double samples;  ///< texels, of where its samples are
    double depth;    ///< of how deep they are
};

class RelaxedFalls {
  public:
    /// Octants of directions (octants.hpp).
    using Octants = std::array<float, 8>;

    RelaxedFalls(const BakeJob& job, double share, const RelaxedRays& rays,
                 const RayErrors& errors);

    /// For each octant at most the distance over depth, in tiles, by which a ray has to go down to
    /// stay below the field behind stored texel (x, y); at most `gentlest`.
    const Octants& all(int x, int y) const { return all_[at(x, y)]; }
    /// The same without the texels that touch this one.
    const Octants& far(int x, int y) const { return far_[at(x, y)]; }

    static constexpr double gentlest = 2;

  private:
    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * columns_ + x; }

    int columns_;
    std::vector<Octants> all_, far_;
};

}  // namespace quadrel
