// Vectors over any number type: GLM's types, constructors and operators. GLM's functions branch on
// values or add in a compiler-dependent order; use those of functions.hpp.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace quadrel {

template <class F>
using vec2 = glm::vec<2, F, glm::defaultp>;
template <class F>
using vec3 = glm::vec<3, F, glm::defaultp>;
template <class F>
using vec4 = glm::vec<4, F, glm::defaultp>;

}  // namespace quadrel
