// The direction of a vector, null included.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "quadrel/num/functions.hpp"

namespace quadrel {

/// v / |v|, or null.
inline glm::dvec3 direction(const glm::dvec3& v) {
    const double squared = dot(v, v);
    return squared > 0 ? v / std::sqrt(squared) : glm::dvec3(0);
}

}  // namespace quadrel
