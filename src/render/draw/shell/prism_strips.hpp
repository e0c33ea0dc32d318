// The triangles that Rabbid76's geometry shader emits (quadrel/relief/shell/prism_strip.hpp).
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <vector>

#include "quadrel/raster/assemble.hpp"
#include "quadrel/relief/shell/prism_strip.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/draw/vertex_stage.hpp"

namespace quadrel {

/// An emitted triangle, its vertices in the order of the strip.
struct StripTriangle {
    std::array<std::uint32_t, 3> index{};   ///< of PrismStrips::vertices
    std::array<std::uint32_t, 3> corner{};  ///< of the mesh's triangle that each lies over
    PrismStrip varyings{};                  ///< at its vertices
};

class PrismStrips {
  public:
    /// `base`: the mesh's own vertices. Depth is the material's, in world units.
    PrismStrips(const Mesh& mesh, const ShadedVertices& base, const Material& material,
                const glm::mat4& projection);

    /// First the mesh's, of height 0, then those of height 1.
    const ShadedVertices& vertices() const { return vertices_; }

    /// Appends the seven triangles of one of the mesh's, its corners as they are drawn.
    void append(const DrawnCorners& drawn, std::vector<StripTriangle>& out) const;

  private:
    const Mesh& mesh_;
    float scale_;
    ShadedVertices vertices_;
    std::vector<glm::vec3> view_nv_;
};

/// The row of one piece of a triangle.
PrimitiveVertices strip_row(const StripTriangle& triangle, const AssembledTriangle& piece);

}  // namespace quadrel
