#include "render/draw/primitive_frame.hpp"

#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "quadrel/num/functions.hpp"
#include "quadrel/scene/quadrics.hpp"
#include "quadrel/scene/tangents.hpp"

namespace quadrel {

glm::vec3 unit_or_null(const glm::vec3& v) {
    const glm::dvec3 wide(v);
    const double squared = dot(wide, wide);
    return squared > 0 ? glm::vec3(wide / std::sqrt(squared)) : glm::vec3(0.0f);
}

glm::vec3 normal_of_corner(const Mesh& mesh, std::size_t triangle, std::size_t corner) {
    const auto& index = mesh.triangles[triangle];
    if (!mesh.normals.empty()) return mesh.normals[index[corner]];
    const glm::dvec3 a(mesh.positions[index[0]]);
    const glm::dvec3 n =
        cross(glm::dvec3(mesh.positions[index[1]]) - a, glm::dvec3(mesh.positions[index[2]]) - a);
    const double length_of_n = length(n);
    return length_of_n > 0 ? glm::vec3(n / length_of_n) : glm::vec3(0.0f);
}

std::array<float, 6> triangle_jacobian(const std::array<glm::vec3, 3>& position,
                                       const std::array<glm::vec2, 3>& uv) {
    const glm::dvec3 e1 = glm::dvec3(position[1]) - glm::dvec3(position[0]);
    const glm::dvec3 e2 = glm::dvec3(position[2]) - glm::dvec3(position[0]);
    const glm::dvec2 d1 = glm::dvec2(uv[1]) - glm::dvec2(uv[0]);
    const glm::dvec2 d2 = glm::dvec2(uv[2]) - glm::dvec2(uv[0]);
    const glm::dvec3 n = cross(e1, e2);
    const double area = dot(n, n);
    std::array<float, 6> J{};
    if (!(area > 0)) return J;
    // The dual basis of the edges in their plane.
    const glm::dvec3 a = cross(e2, n) / area, b = cross(n, e1) / area;
    for (int i = 0; i < 3; ++i) {
        J[static_cast<std::size_t>(i)] = static_cast<float>(a[i] * d1.x + b[i] * d2.x);
        J[static_cast<std::size_t>(3 + i)] = static_cast<float>(a[i] * d1.y + b[i] * d2.y);
    }
    return J;
}

PrimitiveFrames::PrimitiveFrames(const Mesh& mesh, const glm::mat4& model_view,
                                 const std::vector<glm::vec3>& eye,
                                 const std::vector<glm::vec2>& uv, std::string_view frame,
                                 bool quadrics)
    : mesh_(mesh),
      eye_(eye),
      uv_(uv),
      model_view_(model_view),
      normal_matrix_(glm::transpose(glm::inverse(glm::dmat3(glm::dmat4(model_view))))),
      side_(glm::determinant(glm::dmat3(glm::dmat4(model_view))) < 0 ? -1.0f : 1.0f) {
    const bool remapped = !mesh.uvs.empty() && uv != mesh.uvs;
    const auto mapped = [&] {  // with the texture coordinates that the fragments get
        Mesh copy = mesh;
        copy.uvs = uv;
        return copy;
    };
    if (frame == "frame-vertex") {
        make_gradients(mapped());
    } else if (frame == "frame-mikkt" && (remapped || mesh.tangents.empty())) {
        make_mikkt(mapped());
    } else if (!mesh.tangents.empty()) {
        make_own(mesh);
    }
    if (quadrics) make_quadrics(mapped());
}

// Of the mesh in eye space, so that no transform has to know what it does to curvature.
void PrimitiveFrames::make_quadrics(Mesh mesh) {
    mesh.positions = eye_;
    for (glm::vec3& normal : mesh.normals)
        normal = unit_or_null(glm::vec3(glm::dmat3(normal_matrix_) * glm::dvec3(normal)));
    quadrics_ = fitted_quadrics(mesh);
}

void PrimitiveFrames::make_gradients(const Mesh& mesh) {
    const glm::mat3 vectors(model_view_);
    for (const auto& tangents : uv_tangents(mesh)) {
        Corners& corners = corners_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = {vectors * tangents[c].dPdu, vectors * tangents[c].dPdv, 1};
    }
}

void PrimitiveFrames::make_mikkt(const Mesh& mesh) {
    const auto tangents = mikkt_tangents(mesh);
    for (std::size_t t = 0; t < tangents.size(); ++t) {
        Corners& corners = corners_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = {unit_or_null(glm::mat3(model_view_) * glm::vec3(tangents[t][c])),
                          unit_or_null(normal_matrix_ * normal_of_corner(mesh, t, c)),
                          tangents[t][c].w * side_};
    }
}

// glTF's bitangents point up the picture, against v; here all point along it.
void PrimitiveFrames::make_own(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Corners& corners = corners_.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::vec4 tangent = mesh.tangents[mesh.triangles[t][c]];
            corners[c] = {unit_or_null(glm::mat3(model_view_) * glm::vec3(tangent)),
                          unit_or_null(normal_matrix_ * normal_of_corner(mesh, t, c)),
                          -tangent.w * side_};
        }
    }
}

PrimitiveFrame PrimitiveFrames::of(const AssembledTriangle& piece,
                                   const DrawnCorners& drawn) const {
    PrimitiveFrame frame{};
    std::array<std::uint32_t, 3> index;
    for (std::size_t i = 0; i < 3; ++i) index[i] = mesh_.triangles[drawn.triangle][drawn.corner[i]];
    const auto [a, b, c] = index;
    const auto J = triangle_jacobian({eye_[a], eye_[b], eye_[c]}, {uv_[a], uv_[b], uv_[c]});
    std::copy(J.begin(), J.end(), frame.J);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 3; ++i) frame.object_axes[axis][i] = normal_matrix_[axis][i];
    if (!quadrics_.empty()) {
        const std::array<glm::vec2, 3>& own = quadrics_[drawn.triangle];
        const glm::vec2 &first = own[drawn.corner[0]], &second = own[drawn.corner[1]],
                        &third = own[drawn.corner[2]];
        for (int v = 0; v < 3; ++v)
            for (int i = 0; i < 2; ++i)
                frame.quadric[v][i] = weigh(piece.weights[static_cast<std::size_t>(v)].perspective,
                                            first[i], second[i], third[i]);
    }
    if (corners_.empty()) return frame;
    const Corners& corners = corners_[drawn.triangle];
    const Corner &first = corners[drawn.corner[0]], &second = corners[drawn.corner[1]],
                 &third = corners[drawn.corner[2]];
    for (int v = 0; v < 3; ++v) {
        const auto& weights = piece.weights[static_cast<std::size_t>(v)].perspective;
        for (int i = 0; i < 3; ++i) {
            frame.tangent[v][i] =
                weigh(weights, first.tangent[i], second.tangent[i], third.tangent[i]);
            frame.bitangent[v][i] =
                weigh(weights, first.bitangent[i], second.bitangent[i], third.bitangent[i]);
        }
        frame.tangent_sign[v] = weigh(weights, first.sign, second.sign, third.sign);
    }
    return frame;
}

}  // namespace quadrel
