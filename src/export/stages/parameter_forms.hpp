// What texts compute of a parameter before they use it: short expressions, on numbers and written.
#pragma once

#include <cstdint>
#include <span>

#include "quadrel/num/shader/functions.hpp"

namespace quadrel::recorded {

struct WholeForm {
    std::int32_t (*value)(std::int32_t);
    ShaderInt (*text)(const ShaderInt&);
};
struct RealForm {
    float (*value)(float);
    Shader (*text)(const Shader&);
};

/// The simplest first: the parameter itself.
std::span<const WholeForm> whole_forms();
std::span<const RealForm> real_forms();

}  // namespace quadrel::recorded
