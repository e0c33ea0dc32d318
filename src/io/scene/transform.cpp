#include "quadrel/scene/transform.hpp"

#include "io/scene/read.hpp"
#include "quadrel/num/functions.hpp"

namespace quadrel {
namespace {

bool is_matrix(const SceneValue& value) {
    return value.json().is_array() && !value.json().empty() && value.json()[0].is_number();
}

glm::dvec3 read_scale(const SceneValue& value) {
    glm::dvec3 factors;
    if (value.json().is_number())
        factors = glm::dvec3(value.real());
    else
        factors = glm::dvec3(value.vector3());
    if (factors.x * factors.y * factors.z == 0) value.reject("factors other than 0");
    return factors;
}

glm::dmat4 read_rotation(Fields& step) {
    const double degrees = step.get("rotate").number();
    glm::vec3 axis(0, 0, 0);
    const SceneValue where = step.get("axis");
    axis = where.vector3();
    if (length(glm::dvec3(axis)) == 0) where.reject("an axis of some length");
    return rotation(degrees, axis);
}

glm::dmat4 read_step(const SceneValue& value) {
    Fields step(value);
    glm::dmat4 matrix(1.0);
    if (step.has("translate"))
        matrix = translation(step.get("translate").vector3());
    else if (step.has("rotate"))
        matrix = read_rotation(step);
    else if (step.has("scale"))
        matrix = scaling(read_scale(step.get("scale")));
    else
        value.fail("a step without any of them", "one of translate, rotate (with axis), scale");
    step.finish("this step of a transform (one of translate, rotate and scale each)");
    return matrix;
}

}  // namespace

glm::dmat4 read_matrix(const SceneValue& value) {
    const auto numbers = value.numbers(16, 16);
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i % 4][i / 4] = numbers[static_cast<std::size_t>(i)];
    return matrix;
}

glm::mat4 read_transform(const SceneValue& value) {
    glm::dmat4 matrix(1.0);
    if (is_matrix(value)) {
        matrix = read_matrix(value);
    } else {
        if (!value.json().is_array()) value.reject("16 numbers (row by row) or a list of steps");
        for (std::size_t i = 0; i < value.json().size(); ++i)
            matrix = read_step(value.element(i)) * matrix;
    }
    const glm::mat4 rounded(matrix);
    if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
        value.fail("a last row other than 0 0 0 1", "an affine transform");
    // Normals need its inverse.
    if (glm::determinant(glm::dmat3(rounded)) == 0)
        value.fail("a singular matrix", "one with an inverse");
    return rounded;
}

}  // namespace quadrel
