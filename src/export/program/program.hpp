// A material's stages as one program: a vertex shader and a fragment shader.
#pragma once

#include <string>
#include <vector>

#include "export/program/varyings.hpp"
#include "export/table.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

struct ProgramText {
    std::string vertex, fragment;
    std::vector<Attribute> attributes;       ///< that the vertex shader reads
    std::vector<Uniform> numbers, samplers;  ///< that either shader has
};

/// Throws RecordingError with the stage and the reason where there is none.
ProgramText compose_program(const ProgramRequest& request);

/// Slot of a map by the name that it has in shaders, with or without "_nearest"; -1 for others.
int slot_of_map(const std::string& name);

}  // namespace quadrel::recorded
