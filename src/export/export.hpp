// Stages as shaders: the module quadrel-shaders, loaded when something is first exported.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "export/table.hpp"

namespace quadrel {

/// The module's table. Throws UsageError where it is not installed.
const ExportTable& export_table();

/// What is said of the scene of stages that are written by themselves.
struct ExportOptions {
    std::string language = "glsl";
    int side = 1024;  ///< of the maps, in texels
    int lights = 2;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;  ///< of the maps
    float seat = 1;                                     ///< height at which the polygon lies
    bool uniforms = false;  ///< parameters are uniforms where they can be, not constants
};

struct ExportRow {
    std::string id, room, refusal;  ///< refusal: why it cannot be written; empty where it can
};
/// All of Quadrel's own stages.
std::vector<ExportRow> export_rows();

/// The stages' functions and all that they need. Throws UsageError with the reason where there is
/// none.
std::string export_stages(std::span<const StageUse> stages, const ExportOptions& options);

/// A uniform, sampler or attribute of a program.
struct ProgramName {
    std::string type;  ///< as GLSL has it; of an attribute the number of components
    std::string name;
    /// Of a uniform the length of an array, of a sampler the texture slot, of an attribute the
    /// location.
    int number = 0;
};

/// A material's stages as shaders.
struct Program {
    std::string vertex, fragment;
    std::vector<ProgramName> attributes, uniforms, samplers;
};

/// `request` but for whom it tells. Throws UsageError with the stage and the reason where there is
/// none.
Program export_program(ProgramRequest request);

/// Floats by names: of uniforms, or a varying's, one vertex after the other.
using NamedFloats = std::map<std::string, std::vector<float>>;

/// Vertices of an object, in object space (Vertex): floats, one vertex after the other.
struct VertexList {
    int count = 0;
    std::vector<float> position, normal, tangent, binormal, uv;
};

/// What the vertex programs of the request's stages give, with Quadrel's own bits. `uniforms`:
/// those of frame and object. Throws UsageError with the reason where they cannot be run.
NamedFloats vertex_program_values(ProgramRequest request, const VertexList& vertices,
                                  const NamedFloats& uniforms);

}  // namespace quadrel
