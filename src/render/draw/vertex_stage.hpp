// The vertex stage: what becomes of a mesh's vertices before anything is clipped or culled.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "quadrel/scene/camera.hpp"
#include "quadrel/scene/scene.hpp"
#include "render/draw/primitive_frame.hpp"

namespace quadrel {

/// Outputs of the vertex stage, float32 as on a GPU.
struct ShadedVertices {
    std::vector<glm::vec3> eye, normal;
    std::vector<glm::vec4> clip;
    std::vector<glm::vec2> uv;
};

/// Object to eye space for normals.
glm::mat3 normal_matrix(const glm::mat4& model_view);

/// Normals are null in a mesh without.
ShadedVertices shade_vertices(const Mesh& mesh, const Camera& camera, const glm::mat4& model_view,
                              const glm::mat4& texture_matrix);

/// Unit normal of the counter-clockwise side; null for a triangle without area.
glm::vec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Whether a triangle has no area.
bool is_flat(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Whether a transform turns the winding round.
bool is_mirrored(const glm::mat4& model_view);

/// A triangle of a mesh as it is drawn: under a mirroring transform its corners are exchanged, so
/// that the outside stays the outside.
DrawnCorners drawn_corners(std::uint32_t triangle, bool mirrored);

/// The mesh's vertices at them.
std::array<std::uint32_t, 3> indices_of(const Mesh& mesh, const DrawnCorners& drawn);

}  // namespace quadrel
