// What frames and normal maps read of an object's triangles beyond position, normal and UV.
//
// The tangents of a row are what the material's frame makes of them:
//
//     frame         tangent                    sign        bitangent
//     frame-vertex  dP/du, averaged            1           dP/dv, averaged
//     frame-mikkt   MikkTSpace's unit tangent  handedness  unit vertex normal
//     any other     the mesh's own, unit       handedness  unit vertex normal
//
// All in eye space; null where a mesh has nothing of the kind. frame-mikkt takes the mesh's own
// tangents where it has some and no texture matrix turns the UV.
//
// Quadrics are fitted where a stage reads them, with the fragments' texture coordinates.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <string_view>
#include <vector>

#include "quadrel/quad/uniforms.hpp"
#include "quadrel/raster/assemble.hpp"
#include "quadrel/scene/mesh.hpp"

namespace quadrel {

/// A triangle of a mesh with the order in which its corners are drawn.
struct DrawnCorners {
    std::size_t triangle = 0;
    std::array<std::uint32_t, 3> corner{0, 1, 2};  ///< of the mesh's triangle
};

/// Rows for the triangles of one object.
class PrimitiveFrames {
  public:
    /// `eye` and `uv`: the vertex stage's outputs, as long as the mesh; all must outlive this.
    /// `frame`: id of the material's frame. `quadrics`: whether to fit them.
    PrimitiveFrames(const Mesh& mesh, const glm::mat4& model_view,
                    const std::vector<glm::vec3>& eye, const std::vector<glm::vec2>& uv,
                    std::string_view frame = {}, bool quadrics = false);

    /// The row of one piece of a triangle.
    PrimitiveFrame of(const AssembledTriangle& piece, const DrawnCorners& drawn) const;

  private:
    /// One corner's part of a row.
    struct Corner {
        glm::vec3 tangent{0}, bitangent{0};
        float sign = 0;
    };
    using Corners = std::array<Corner, 3>;

    void make_own(const Mesh& mesh);
    void make_gradients(const Mesh& mesh);
    void make_mikkt(const Mesh& mesh);
    void make_quadrics(Mesh mesh);

    const Mesh& mesh_;
    const std::vector<glm::vec3>& eye_;
    const std::vector<glm::vec2>& uv_;
    glm::mat4 model_view_;
    glm::mat3 normal_matrix_;
    float side_;                    ///< -1 where the transform mirrors
    std::vector<Corners> corners_;  ///< a triangle each, eye space; empty where all are null
    std::vector<std::array<glm::vec2, 3>> quadrics_;  ///< likewise
};

/// v / |v|, or null.
glm::vec3 unit_or_null(const glm::vec3& v);

/// The normal of a corner in object space, as the mesh has it; the unit normal of the triangle in a
/// mesh without normals.
glm::vec3 normal_of_corner(const Mesh& mesh, std::size_t triangle, std::size_t corner);

/// Gradients of u and v in the plane of a triangle, in double from its vertices; 0 where it has no
/// area.
std::array<float, 6> triangle_jacobian(const std::array<glm::vec3, 3>& position,
                                       const std::array<glm::vec2, 3>& uv);

}  // namespace quadrel
