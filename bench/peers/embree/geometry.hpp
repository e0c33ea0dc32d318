// The height field as Embree's geometry.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>

#include "embree/rays.hpp"
#include "picture.hpp"
#include "quadrel/texture/texture.hpp"

namespace quadrel::peers {

enum class GeometryKind { grid, triangles };

/// A scene of Embree's with a device of its own, built.
class EmbreeScene {
  public:
    /// The plane's `part`, a vertex for each texel's centre, heights repeated, `depth` deep.
    EmbreeScene(const Texture& heights, const Part& part, double depth, GeometryKind kind,
                int threads);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene scene() const { return scene_; }
    const Time& build() const { return build_; }
    double memory_mib() const;
    /// Rays in the widest packet that Embree traces as such on this processor: 16, 8 or 4.
    int widest_packet() const;

  private:
    static bool count_bytes(void* self, ssize_t bytes, bool after);

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::atomic<std::int64_t> bytes_{0};
    Time build_;
};

}  // namespace quadrel::peers
