#include "render/draw/vertex_stage.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

namespace quadrel {
namespace {

/// Towards the counter-clockwise side, twice the area long.
glm::dvec3 face_vector(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 u = glm::dvec3(b) - glm::dvec3(a), v = glm::dvec3(c) - glm::dvec3(a);
    return {u.y * v.z - v.y * u.z, u.z * v.x - v.z * u.x, u.x * v.y - v.x * u.y};
}

}  // namespace

glm::mat3 normal_matrix(const glm::mat4& model_view) {
    return glm::mat3(glm::transpose(glm::inverse(glm::dmat3(glm::dmat4(model_view)))));
}

ShadedVertices shade_vertices(const Mesh& mesh, const Camera& camera, const glm::mat4& model_view,
                              const glm::mat4& texture_matrix) {
    ShadedVertices out;
    const glm::mat3 normals = normal_matrix(model_view);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec4 eye = model_view * glm::vec4(mesh.positions[i], 1.0f);
        out.eye.emplace_back(eye);
        out.clip.push_back(camera.projection * eye);
        out.normal.push_back(mesh.normals.empty() ? glm::vec3(0.0f) : normals * mesh.normals[i]);
        const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0.0f) : mesh.uvs[i];
        out.uv.emplace_back(texture_matrix * glm::vec4(uv, 0.0f, 1.0f));
    }
    return out;
}

glm::vec3 face_normal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 n = face_vector(a, b, c);
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return length > 0 ? glm::vec3(n / length) : glm::vec3(0.0f);
}

bool is_flat(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return face_vector(a, b, c) == glm::dvec3(0.0);
}

bool is_mirrored(const glm::mat4& model_view) {
    return glm::determinant(glm::dmat3(glm::dmat4(model_view))) < 0;
}

DrawnCorners drawn_corners(std::uint32_t triangle, bool mirrored) {
    DrawnCorners drawn{triangle, {0, 1, 2}};
    if (mirrored) std::swap(drawn.corner[1], drawn.corner[2]);
    return drawn;
}

std::array<std::uint32_t, 3> indices_of(const Mesh& mesh, const DrawnCorners& drawn) {
    const auto& corners = mesh.triangles[drawn.triangle];
    return {corners[drawn.corner[0]], corners[drawn.corner[1]], corners[drawn.corner[2]]};
}

}  // namespace quadrel
