// The vertices of an object's triangles as vertex programs read them.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <vector>

#include "quadrel/quad/uniforms.hpp"
#include "quadrel/raster/assemble.hpp"
#include "quadrel/scene/mesh.hpp"
#include "render/draw/primitive_frame.hpp"

namespace quadrel {

/// Rows for the triangles of one object.
class VertexRows {
  public:
    /// `uv`: the vertex stage's texture coordinates, as long as the mesh; the mesh and they must
    /// outlive this.
    VertexRows(const Mesh& mesh, const glm::mat4& model_view, const std::vector<glm::vec2>& uv);

    /// The row of one piece of a triangle.
    PrimitiveVertices of(const AssembledTriangle& piece, const DrawnCorners& drawn) const;

  private:
    struct Axes {
        glm::vec3 tangent{0}, binormal{0};
    };

    void take_own_axes();
    void make_axes();

    const Mesh& mesh_;
    const std::vector<glm::vec2>& uv_;
    glm::mat4 to_eye_, to_object_;
    std::vector<std::array<Axes, 3>> axes_;  ///< a triangle and corner each
};

}  // namespace quadrel
