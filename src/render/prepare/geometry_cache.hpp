// The geometry of the frame before, for frames that change something else.
#pragma once

#include <string>

#include "render/draw/geometry.hpp"

namespace quadrel {

/// Of everything that assemble_geometry reads, bit by bit: equal keys, equal geometry.
std::string geometry_key(const Scene& scene, const HardwareModel& hardware,
                         const GeometryParts& parts);

class GeometryCache {
  public:
    /// The geometry; assembled unless what was given back last is that of an equal key.
    Geometry take(const Scene& scene, const HardwareModel& hardware, const GeometryParts& parts);

    /// What `take` gave, after its frame. Without that the next frame assembles.
    void give_back(Geometry geometry);

    /// How often it was assembled.
    int assembled() const { return assembled_; }

  private:
    std::string key_, taken_;  ///< of `geometry_`, and of what was taken; empty: none
    Geometry geometry_;
    int assembled_ = 0;
};

}  // namespace quadrel
