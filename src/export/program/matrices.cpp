#include "export/program/matrices.hpp"

#include <vector>

namespace quadrel::recorded {
namespace {

/// An element of a uniform array.
std::string element(const Uniform& uniform, int index, const Dialect& dialect) {
    return dialect.use_of(uniform, uniform.name + "[" + std::to_string(index) + "]");
}

}  // namespace

std::string object_axis(int axis, const Dialect& dialect) {
    std::string text = dialect.type(Type::vec3) + "(";
    for (int row = 0; row < 3; ++row)
        text += (row == 0 ? "" : ", ") + element(normal_matrix, 3 * row + axis, dialect);
    return text + ")";
}

std::string rows_times(const Uniform& matrix, Type type, const std::string& point,
                       const Dialect& dialect) {
    std::string text = dialect.type(type) + "(";
    for (int row = 0; row < components_of(type); ++row) {
        text += row == 0 ? "affine(" : ", affine(";
        for (int column = 0; column < 4; ++column)
            text += element(matrix, 4 * row + column, dialect) + ", ";
        text += point + ")";
    }
    return text + ")";
}

std::string normal_times(const Dialect& dialect) {
    std::string text = dialect.type(Type::vec3) + "(";
    for (int row = 0; row < 3; ++row) {
        text += row == 0 ? "linear_row(" : ", linear_row(";
        for (int column = 0; column < 3; ++column)
            text += element(normal_matrix, 3 * row + column, dialect) + ", ";
        text += "normal)";
    }
    return text + ")";
}

std::string row_functions(const Dialect& dialect) {
    const std::vector<Named> of_point = {{"a", Type::real},
                                         {"b", Type::real},
                                         {"c", Type::real},
                                         {"d", Type::real},
                                         {"p", Type::vec3}};
    const std::vector<Named> of_vector = {
        {"a", Type::real}, {"b", Type::real}, {"c", Type::real}, {"v", Type::vec3}};
    return "// A row of a matrix times a point, and times a vector.\n" +
           dialect.helper_head(Type::real, "affine", of_point) +
           "\n    return (a * p.x + b * p.y) + (c * p.z + d);\n}\n" +
           dialect.helper_head(Type::real, "linear_row", of_vector) +
           "\n    return a * v.x + b * v.y + c * v.z;\n}\n\n";
}

}  // namespace quadrel::recorded
