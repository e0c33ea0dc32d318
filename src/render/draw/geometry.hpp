// The front end: a scene's meshes as screen triangles with the data that interpolation reads.
#pragma once

#include <cstdint>
#include <vector>

#include "quadrel/quad/uniforms.hpp"
#include "quadrel/raster/assemble.hpp"
#include "quadrel/raster/planes.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// One triangle to draw, or one piece of a clipped one.
struct DrawnTriangle {
    ScreenTriangle screen;
    std::uint32_t object = 0;     ///< index into the scene's objects
    std::uint32_t primitive = 0;  ///< triangle of the object's mesh
    std::uint32_t material = 0;
};

/// What stages read of triangles, a row each.
struct PrimitiveRows {
    std::vector<PrimitiveData> data;
    std::vector<PrimitiveFrame> frames;  ///< as long as `data`, or empty where nothing reads them
    std::vector<PrimitiveVertices> vertices;  ///< likewise
};

/// Everything to draw, in submission order; rows run parallel to `triangles`.
struct Geometry : PrimitiveRows {
    std::vector<DrawnTriangle> triangles;
    std::vector<PlaneSetup> planes;  ///< likewise; empty if attributes are interpolated exactly
    /// Where a hardware's planes, and so the rows, are those of whole triangles: the rows of the
    /// pieces that clipping has made of them, for who interpolates exactly. Else empty.
    PrimitiveRows pieces;
    PrimitiveCounts counts;
};

/// What stages read of triangles beyond PrimitiveData.
struct GeometryParts {
    bool frames = false;    ///< tangents, the triangles' own J and the objects' axes
    bool vertices = false;  ///< the vertices as submitted
    bool quadrics = false;  ///< within `frames`: quadrics fitted to the meshes
    /// Triangles between the samples of the picture, too: for those who take samples elsewhere.
    bool all_triangles = false;
};

/// Vertex stage, clipping, snapping and culling of every visible object.
Geometry assemble_geometry(const Scene& scene, const HardwareModel& hardware,
                           const GeometryParts& parts = {});

/// The scene's hardware model with its own settings applied.
HardwareModel scene_hardware(const Scene& scene);

/// Camera and lights in eye space.
FrameUniforms frame_uniforms(const Scene& scene, const HardwareModel& hardware);

MaterialUniforms material_uniforms(const Material& material);

}  // namespace quadrel
