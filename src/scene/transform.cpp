#include "quadrel/scene/transform.hpp"

#include "quadrel/num/functions.hpp"
#include "scene/degrees.hpp"

namespace quadrel {

glm::dmat4 translation(const glm::dvec3& offset) {
    glm::dmat4 matrix(1.0);
    matrix[3] = glm::dvec4(offset, 1);
    return matrix;
}

glm::dmat4 scaling(const glm::dvec3& factors) {
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 3; ++i) matrix[i][i] = factors[i];
    return matrix;
}

// Rodrigues' formula: c I + (1 - c) a a^T + s [a]x.
glm::dmat4 rotation(double degrees, const glm::dvec3& axis) {
    const auto [s, c] = sin_cos_degrees(degrees);
    const glm::dvec3 a = axis * (1 / length(axis));
    glm::dmat4 matrix(1.0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            matrix[column][row] = (1 - c) * a[row] * a[column] + (row == column ? c : 0);
    matrix[1][0] -= s * a.z;
    matrix[2][0] += s * a.y;
    matrix[0][1] += s * a.z;
    matrix[2][1] -= s * a.x;
    matrix[0][2] -= s * a.y;
    matrix[1][2] += s * a.x;
    return matrix;
}

}  // namespace quadrel
