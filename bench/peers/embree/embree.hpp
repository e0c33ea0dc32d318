// The wall as geometry for Embree, and the rays of a frame's pixels.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "picture.hpp"

namespace quadrel::peers {

/// A way to trace: what the height field is made of, and how many rays a call takes.
struct EmbreeWay {
    std::string name;
    Time build;         ///< of what rays are traced through
    double memory_mib;  ///< Embree's own, vertices included
};

class EmbreeWall {
  public:
    virtual ~EmbreeWall() = default;
    virtual const std::vector<EmbreeWay>& ways() const = 0;
    /// Traces a ray for each pixel, and from each hit one towards the light where `shadows`.
    virtual void trace(std::size_t way, bool shadows) = 0;
    /// Depth of each pixel's hit in units of the relief's, 1 where there was none; the top row
    /// first, as all that follow.
    virtual std::vector<float> depths() const = 0;
    /// 1 where the ray towards the light met nothing, else 0.
    virtual std::vector<float> lit() const = 0;
    virtual double missed() const = 0;  ///< share of rays without a hit
};

/// The height field of the scene's only material between its texels' centres, as triangles and as a
/// grid, on so many threads. Null where there is no Embree; then `why` says so.
std::unique_ptr<EmbreeWall> build_embree_wall(const Scene& scene, int threads, std::string& why);

}  // namespace quadrel::peers
