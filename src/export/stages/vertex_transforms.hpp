// Functions that take vertices from object space to eye space and back, as vertex programs call
// them.
#pragma once

#include <string>
#include <vector>

#include "export/print/dialect.hpp"

namespace quadrel::recorded {

/// The matrix that a call of one of them knows; null for what is none.
const Uniform* matrix_of_transform(const Node& node);

/// Their names.
std::vector<std::string> transform_names();

/// Those that `text` calls, to stand in front of it, behind the uniforms.
std::string transform_functions(const std::string& text, const Dialect& dialect);

}  // namespace quadrel::recorded
