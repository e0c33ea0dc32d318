// Names of enumerators and values, as scene files and channels spell them.
#pragma once

#include <string>

#include "quadrel/quad/value.hpp"
#include "quadrel/scene/settings.hpp"

namespace quadrel {

std::string name_of(Conventions conventions);
std::string name_of(Hardware hardware);

/// A component of a value by its channel's name, or in the same style where there is no channel:
/// "P.X", "hit.U", "J.V.Z", "r", "shadow.0.visibility", "uv_rate.U".
std::string component_name(Value v, int component, int light = 0);

}  // namespace quadrel
