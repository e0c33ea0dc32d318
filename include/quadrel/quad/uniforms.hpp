// What is the same for all fragments of a batch: plain data that crosses into the instruction-set
// modules.
#pragma once

#include <cstdint>

#include "quadrel/num/derivative.hpp"
#include "quadrel/scene/settings.hpp"
#include "quadrel/texture/height_maxima.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// Texture uses that a stage may ask for: first what a scene names, then what is baked from the
/// height field or the depth layers (bake.hpp says what each holds).
enum class TextureSlot : std::int32_t {
    height,
    color,
    gloss,
    emissive,
    normal,
    environment,
    layers,
    layers_2,
    layers_3,
    layer_normals_x,
    layer_normals_y,
    color_2,
    color_3,
    color_4,
    max_mip,
    min_max,
    texel_max,
    cone,
    cone_robust,
    cone_quick,
    cone_rabbid,
    cone_cell,
    relaxed_cone,
    relaxed_cone_exact,
    quad_cone,
    aniso_cone,
    distance,
    distance_exact,
    horizon,
    horizon_sampled,
    rmq,
    layer_bounds,
    ddm,
    gdm,
    vdm,
    prewarp,
    count
};

/// Slots from this one on hold baked maps; `prewarp` one that is made for a view.
inline constexpr auto first_baked_slot = TextureSlot::max_mip;

/// Whether a slot holds depth layers.
constexpr bool is_layers(TextureSlot slot) {
    return slot >= TextureSlot::layers && slot <= TextureSlot::layers_3;
}

/// What the map of a slot is made of: a slot that scenes name.
constexpr TextureSlot source_of(TextureSlot slot) {
    if (slot == TextureSlot::layer_bounds) return TextureSlot::layers;
    return slot >= first_baked_slot ? TextureSlot::height : slot;
}

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
    float eye[3];                     ///< centre of projection, or the direction towards it
    std::int32_t orthographic;        ///< 1: `eye` is a direction
    float eye_to_world[9];            ///< rotation rows: world = eye_to_world * eye-space vector
    float projection[16];             ///< eye to clip space, rows
    float depth_scale, depth_offset;  ///< window depth = scale * (clip z / clip w) + offset
    DerivativeMode derivatives;
    Interpolation interpolation;
    std::int32_t light_count;
    LightUniforms lights[8];
};

struct MaterialUniforms {
    float depth;                  ///< D: relief thickness in world units, or in `tiles`
    std::int32_t depth_in_tiles;  ///< 1: `depth` is in lengths of one tile of the texture
    float fade_from, fade_to;     ///< cosines of N and V between which the relief fades out
    std::int32_t noise_octaves;   ///< 0: heights come from the map, else from noise (noise.hpp)
    float noise_frequency;        ///< lattice cells a tile of the first octave
    float seat;                   ///< sigma: height at which the polygon lies
    /// 1: every look-up in the height map gives a height in [height_low, height_high], the map is
    /// flat where the two are equal, and no one asked how many steps or fetches searches take. Then
    /// steps that cannot meet the surface may be left out.
    std::int32_t heights_bounded;
    float height_low, height_high;
    /// Bounds of parts of the height map; null where every step is to be made.
    const HeightMaxima* maxima;
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

/// What only some frames and normal maps read of a triangle, in an array of its own.
struct PrimitiveFrame {
    float tangent[3][3];    ///< a vertex each, eye space
    float tangent_sign[3];  ///< handedness: bitangent = sign * cross(N, T)
    float bitangent[3][3];
    float J[6];               ///< of the whole triangle: gradients of u and v in its plane
    float object_axes[3][3];  ///< columns of the normal matrix: object to eye space
    float quadric[3][2];      ///< a vertex each (scene/quadrics.hpp), eye space; else 0
    float unused[6];
};

/// What vertex programs read of a triangle (vertex_program.hpp), in an array of its own: the
/// vertices as submitted, whatever clipping makes of them, in object space. A ShellFace in shells.
struct PrimitiveVertices {
    float position[3][3];
    float normal[3][3];    ///< the mesh's own, as it has them; the face's, unit, of flat meshes
    float tangent[3][3];   ///< unit, along growing u: the mesh's own, or from its UV
    float binormal[3][3];  ///< along growing v, likewise
    float uv[3][2];
    float weights[3][3];  ///< of these vertices, at each vertex of the piece that is drawn
    float to_eye[12];     ///< rows of the affine map from object to eye space
    float to_object[12];  ///< and of its inverse
    float unused[5];
};

inline constexpr int primitive_floats = sizeof(PrimitiveData) / sizeof(float);
static_assert(primitive_floats == 32, "rows of 128 bytes");
inline constexpr int frame_floats = sizeof(PrimitiveFrame) / sizeof(float);
static_assert(frame_floats == 48, "rows of 192 bytes");
static_assert(sizeof(PrimitiveVertices) == 80 * sizeof(float), "rows of 320 bytes");

}  // namespace quadrel
