// Which stages are written as shaders, for lists and explanations.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "render/lists/rows.hpp"

namespace quadrel::cli {

/// Why the stage is not written as a shader; empty where it is, nothing where that is not known: of
/// stages of plugins, and where the module that writes shaders is not installed.
std::optional<std::string> why_not_a_shader(std::string_view id);

/// The same of rows of algorithms, a line and `not_a_shader` each.
void add_shader_reasons(ListRows& rows);

}  // namespace quadrel::cli
