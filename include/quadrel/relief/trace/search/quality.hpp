// Open 3D Engine's quality of parallax: 16 2^quality steps.
#pragma once

#include "quadrel/quad/parameter.hpp"

namespace quadrel {

inline constexpr ValueName quality_names[] = {{0, "low"}, {1, "medium"}, {2, "high"}, {3, "ultra"}};

/// The parameter `quality`.
template <auto member>
constexpr ParameterText quality_parameter() {
    return choice<member>("quality", "16, 32, 64 or 128 steps", quality_names, 0);
}

}  // namespace quadrel
