// A stage's parameter in words.
#pragma once

#include <string>

#include "quadrel/quad/stage.hpp"

namespace quadrel {

/// "steps = 128 (1 to 65536): steps over the relief's depth"; the unit stands after the range;
/// "mode = relief (0 basic, 1 steep, 2 relief): the shader's mode".
std::string parameter_text(const ParameterText& parameter);

}  // namespace quadrel
