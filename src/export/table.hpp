// What the module quadrel-shaders exports: plain data, as every module.
#pragma once

#include <cstdint>

#include "quadrel/quad/uniforms.hpp"
#include "quadrel/quad/value.hpp"

namespace quadrel {

/// A stage that the module knows.
struct ExportedStage {
    const char* id;
    const char* room;
    const char* refusal;  ///< why it cannot be written; null where it can
};

/// A stage as it is to be written.
struct StageUse {
    const char* id;
    const void* params;      ///< the stage's Params; null: the defaults
    std::int32_t light = 0;  ///< which light a stage a light serves
};

/// Functions of stages in one text, for scenes of which little is known.
struct ExportRequest {
    const char* language;  ///< find_dialect(language)
    const StageUse* stages;
    std::int32_t stage_count;
    std::int32_t side;  ///< of the maps, in texels
    std::int32_t lights;
    Wrap wrap_u, wrap_v;  ///< of the maps
    float seat;
    std::int32_t uniforms;  ///< 1: parameters are uniforms where they can be; 0: constants
    /// Receives the text, or why there is none.
    void (*put)(void* to, const char* text);
    void* to;
};

/// What a component of a program's target holds.
struct ProgramChannel {
    enum class Kind : std::int32_t {
        none,
        value,       ///< `component` of `value`, of a value a light that of `light`
        coverage,    ///< 1
        z,           ///< distance of the hit along the view axis
        lod_lambda,  ///< level of detail of the texture coordinates before clamps
        lod_level    ///< and after them
    };
    Kind kind = Kind::none;
    Value value = Value::P;
    std::int32_t light = 0, component = 0;
    bool operator==(const ProgramChannel&) const = default;
};

/// Most targets that a program draws into at once.
inline constexpr int most_targets = 8;

struct ProgramPass {
    ProgramChannel channels[most_targets][4];
    std::int32_t target_count;
};

/// All stages of a material as a vertex shader and a fragment shader.
struct ProgramRequest {
    const char* language;
    const char* material;    ///< its name, for a comment
    const StageUse* stages;  ///< in the order of the data flow
    std::int32_t stage_count;
    const FrameUniforms* frame;
    const MaterialUniforms* uniforms;
    /// Without texels; null where the material has none.
    const SampledTexture* textures[texture_slot_count];
    const ProgramPass* passes;
    std::int32_t pass_count;
    float discard_below;           ///< opacity below which fragments are discarded; < 0: never
    std::int32_t clips;            ///< 1: fragments of Status::clip are discarded
    std::int32_t writes_depth;     ///< 1: with the depth of their hit
    std::int32_t has_flat_meshes;  ///< 1: some have no normals of their own (flat_faces)
    std::int32_t centroid;         ///< 1: varyings are taken at the centroid
    std::int32_t draws_shells;     ///< 1: vertices are those of shells, which are shaded alone
    /// What the vertices have, by location: what vertex programs give is computed where it is not
    /// among them. None: vertices have all that is asked for.
    const char* const* attributes;
    std::int32_t attribute_count;
    /// Receives a part of the program, or "refusal" and why there is none:
    ///     vertex fragment      the texts
    ///     attribute            "3 position 0": components, name, location of a vertex attribute
    ///     uniform              "vec3 eye 0": type, name, length of an array or 0
    ///     sampler              "sampler2D height_map 0": type, name, slot
    void (*put)(void* to, const char* part, const char* text);
    void* to;
};

/// Vertices of an object whose vertex programs are run: arrays of floats, one vertex after the
/// other.
struct VertexRun {
    const ProgramRequest* program;  ///< `put` receives "refusal" and why, where it cannot be run
    std::int32_t count;
    /// In object space, as Vertex has them; UV as the texture matrix has left it.
    const float *position, *normal, *tangent, *binormal, *uv;
    /// The values of a uniform of that name; null for others.
    const float* (*uniform)(const void* of, const char* name);
    const void* uniforms;
    /// Receives what a varying of that name is at the vertices, and how many floats that are.
    void (*put)(void* to, const char* name, const float* values, std::int32_t floats);
    void* to;
};

struct ExportTable {
    std::uint32_t magic, abi_version;
    /// All stages, in the order of the data flow.
    void (*stages)(void (*put)(void* to, const ExportedStage* stage), void* to);
    /// Whether there is a text.
    bool (*write)(const ExportRequest* request);
    bool (*write_program)(const ProgramRequest* request);
    /// Whether all of the program's varyings have been put.
    bool (*run_vertices)(const VertexRun* run);
};

inline constexpr std::uint32_t export_magic = 0x58455251;  // "QREX"
inline constexpr std::uint32_t export_abi_version = 5;
inline constexpr const char* export_symbol = "quadrel_export_table";

}  // namespace quadrel
