#include "render/primitive_frame.hpp"

#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "quadrel/num/functions.hpp"

namespace quadrel {

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
                                 const std::vector<glm::vec2>& uv)
    : mesh_(mesh),
      eye_(eye),
      uv_(uv),
      model_view_(model_view),
      normal_matrix_(glm::transpose(glm::inverse(glm::dmat3(glm::dmat4(model_view))))) {}

PrimitiveFrame PrimitiveFrames::of(const AssembledTriangle& piece,
                                   const std::array<std::uint32_t, 3>& index) const {
    PrimitiveFrame frame{};
    const auto [a, b, c] = index;
    const auto J = triangle_jacobian({eye_[a], eye_[b], eye_[c]}, {uv_[a], uv_[b], uv_[c]});
    std::copy(J.begin(), J.end(), frame.J);
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 3; ++i) frame.object_axes[axis][i] = normal_matrix_[axis][i];
    if (mesh_.tangents.empty()) return frame;
    const glm::vec4 stored[3] = {mesh_.tangents[a], mesh_.tangents[b], mesh_.tangents[c]};
    const glm::vec3 tangent[3] = {model_view_ * glm::vec3(stored[0]),
                                  model_view_ * glm::vec3(stored[1]),
                                  model_view_ * glm::vec3(stored[2])};
    for (int v = 0; v < 3; ++v) {
        const auto& weights = piece.weights[static_cast<std::size_t>(v)].perspective;
        for (int i = 0; i < 3; ++i)
            frame.tangent[v][i] = weigh(weights, tangent[0][i], tangent[1][i], tangent[2][i]);
        frame.tangent_sign[v] = weigh(weights, stored[0].w, stored[1].w, stored[2].w);
    }
    return frame;
}

}  // namespace quadrel
