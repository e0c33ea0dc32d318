// Matrices as programs have them: uniform arrays of numbers, by rows.
#pragma once

#include <string>

#include "export/print/dialect.hpp"

namespace quadrel::recorded {

inline const Uniform model_view{"model_view", "float", 16}, projection{"projection", "float", 16};
inline const Uniform texture_matrix{"texture_matrix", "float", 16};
inline const Uniform normal_matrix{"normal_matrix", "float", 9};

/// An object's axis in eye space: a column of the normal matrix.
std::string object_axis(int axis, const Dialect& dialect);

/// Rows of a matrix times a point, summed in the order of the reference.
std::string rows_times(const Uniform& matrix, Type type, const std::string& point,
                       const Dialect& dialect);
/// The normal matrix times the vertex's normal.
std::string normal_times(const Dialect& dialect);

/// The functions that rows_times and normal_times call.
std::string row_functions(const Dialect& dialect);

}  // namespace quadrel::recorded
