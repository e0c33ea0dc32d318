// What is the same for all fragments of a batch: plain data that crosses into the instruction-set
// modules.
#pragma once

#include <cstdint>

#include "quadrel/num/derivative.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// Texture uses that a stage may ask for.
enum class TextureSlot : std::int32_t {
    height,
    color,
    gloss,
    emissive,
    normal,
    environment,
    count
};

inline constexpr int texture_slot_count = static_cast<int>(TextureSlot::count);

/// A light in eye space. `position` is the direction towards the light when it is directional.
struct LightUniforms {
    float position[3];
    std::int32_t directional;
    float ambient[3], diffuse[3], specular[3];
    float intensity;
    float attenuation[3];  ///< constant, linear, quadratic in the distance (world units)
};

struct FrameUniforms {
    float eye[3];               ///< centre of projection, or the direction towards it
    std::int32_t orthographic;  ///< 1: `eye` is a direction
    float eye_to_world[9];      ///< rotation rows: world = eye_to_world * eye-space vector
    DerivativeMode derivatives;
    std::int32_t light_count;
    LightUniforms lights[8];
};

struct MaterialUniforms {
    float depth;  ///< D: relief thickness in world units
    float seat;   ///< sigma: height at which the polygon lies
    float ambient[3], diffuse[3], specular[3], emission[3];
    float shininess;
};

/// One triangle after clipping, as interpolation reads it: clip w and attributes at its vertices.
struct PrimitiveData {
    float w[3];
    float position[3][3];
    float normal[3][3];
    float uv[3][2];
    float face_normal[3];
    float unused[2];
};
inline constexpr int primitive_floats = sizeof(PrimitiveData) / sizeof(float);
static_assert(primitive_floats == 32, "rows of 128 bytes");

}  // namespace quadrel
