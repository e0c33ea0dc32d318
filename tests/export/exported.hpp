// The functions that emit.cpp writes as C++ when the tests are built.
#pragma once

#include <cstdint>

namespace quadrel::export_tests {

/// A fragment's inputs and outputs: an array of floats, or of integers, for each slot. What its
/// stage computes at the vertices, interpolated, as the function has it.
struct FragmentArrays {
    const void* const* inputs;
    void* const* outputs;
    int lane;
    const float* varyings;
};

/// A vertex' attributes, and what the stage's vertex program makes of them.
struct VertexArrays {
    const float *position, *normal, *tangent, *binormal, *mapped_uv;
    float* varyings;
};
/// Most floats that a stage computes at the vertices.
inline constexpr int most_varying_floats = 16;

struct ExportedFunction {
    const char* id;
    bool uses_neighbours, has_branches;
    void (*run)(const FragmentArrays& arrays);
    int varying_floats;                              ///< 0: there is no vertex program
    void (*run_vertex)(const VertexArrays& arrays);  ///< null likewise
};
extern const ExportedFunction exported_functions[];
extern const int exported_count;

/// Functions with an error planted into their text: `what` says which.
struct PlantedFunction {
    ExportedFunction function;
    const char* what;
};
extern const PlantedFunction planted_functions[];
extern const int planted_count;

/// Functions whose constants for parameters are changed in their text, and to what.
struct EditedParameter {
    const char* name;
    double value;
};
struct EditedFunction {
    ExportedFunction function;
    const EditedParameter* parameters;
    int count;
};
extern const EditedFunction edited_functions[];
extern const int edited_count;

/// Side of the maps, and how many lights there are.
inline constexpr int exported_side = 64, exported_lights = 2;

}  // namespace quadrel::export_tests
