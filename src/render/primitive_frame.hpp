// What frames and normal maps read of an object's triangles beyond position, normal and UV.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <vector>

#include "quadrel/quad/uniforms.hpp"
#include "quadrel/raster/assemble.hpp"
#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// Rows for the triangles of one object.
class PrimitiveFrames {
  public:
    /// `eye` and `uv`: the vertex stage's outputs, as long as the mesh; all must outlive this.
    PrimitiveFrames(const Mesh& mesh, const glm::mat4& model_view,
                    const std::vector<glm::vec3>& eye, const std::vector<glm::vec2>& uv);

    /// The row of one piece of the triangle of vertices `index`.
    PrimitiveFrame of(const AssembledTriangle& piece,
                      const std::array<std::uint32_t, 3>& index) const;

  private:
    const Mesh& mesh_;
    const std::vector<glm::vec3>& eye_;
    const std::vector<glm::vec2>& uv_;
    glm::mat3 model_view_, normal_matrix_;
};

/// Gradients of u and v in the plane of a triangle, in double from its vertices; 0 where it has no
/// area.
std::array<float, 6> triangle_jacobian(const std::array<glm::vec3, 3>& position,
                                       const std::array<glm::vec2, 3>& uv);

}  // namespace quadrel
