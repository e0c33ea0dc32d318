// A scene: plain structs, no input or output. scene files are read by src/io.
#pragma once

#include <array>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/scene/mesh.hpp"
#include "quadrel/scene/parameter_value.hpp"
#include "quadrel/scene/settings.hpp"
#include "quadrel/texture/selection.hpp"
#include "quadrel/texture/texture_cache.hpp"

namespace quadrel {

/// World to eye and eye to clip space. Eye space is right-handed and looks down -z; `projection` is
/// made for the scene's conventions (depth range, direction of clip y).
struct Camera {
    glm::mat4 view{1.0f};
    glm::mat4 projection{1.0f};
    bool reversed_z = false;  ///< the near plane has the largest depth: greater passes, clear to 0
};

/// A texture as a scene names it.
struct TextureReference {
    std::filesystem::path file;
    ImageSelection selection;  ///< of an EXR file of several layers or parts
    std::string swizzle;  ///< per output channel: r g b a 0 1 1-r ..., or "alpha-or-first"; empty:
                          ///< as stored
    bool srgb = false;    ///< colour channels are sRGB-encoded in the file
    std::optional<TexelFormat> format;  ///< the file's own if absent
    MipRule mip_rule = MipRule::box;
    bool flip_v = false;     ///< row 0 of the texture is the file's last row
    bool allow_nan = false;  ///< NaN and infinite texels are kept, and counted in the statistics
    SamplerState sampler;
    std::string key;  ///< where the scene file names it, for messages
};

/// Heights of gradient noise in place of a height map (relief/noise.hpp).
struct NoiseHeights {
    /// Keeps the last octave's lattice within what a float tells apart.
    static constexpr int max_octaves = 10;
    static constexpr double max_frequency = 4096;

    float frequency = 8;  ///< lattice cells a tile of the first octave; whole numbers tile
    int octaves = 4;
};

/// The six faces of an environment map, +X -X +Y -Y +Z -Z.
struct Environment {
    std::array<std::filesystem::path, 6> faces;
    std::array<ImageSelection, 6> selections;  ///< which image of each face's file
    bool srgb = false;
    std::optional<TexelFormat> format;
    MipRule mip_rule = MipRule::box;
    SamplerState sampler;
    std::string key;
};

/// A stage and the values of its parameters, by name; checked against the stage when planned.
struct StageChoice {
    std::string id;  ///< empty: the default
    std::map<std::string, ParameterValue> parameters;
    std::string key;  ///< where the scene file names it, for messages
};

/// Relief and its shading. Depth and seat are the height field's (design: D and sigma).
struct Material {
    std::string name;
    std::string key;  ///< where the scene file describes it, for messages; may be empty
    StageChoice frame, trace, clip, frag_depth, surface, shadow, occlusion, shade;
    float depth = 0.05f;          ///< D: relief thickness in world (eye-space) length units, >= 0
    bool depth_in_tiles = false;  ///< `depth` is in lengths of one tile of the texture instead
    /// Angles between N and V in degrees: the relief fades from its depth to none. No fading
    /// unless fade_from < fade_to.
    double fade_from = 90, fade_to = 90;
    float seat = 1.0f;  ///< sigma in [0, 1]: the height at which the polygon lies; 1 = inset
    glm::vec4 ambient{0.1f, 0.1f, 0.1f, 1}, diffuse{0.5f, 0.5f, 0.5f, 1};
    glm::vec4 specular{0.3f, 0.3f, 0.3f, 1}, emission{0, 0, 0, 1};
    float shininess = 50;
    glm::mat4 texture_matrix{1.0f};                    ///< applied to (u, v, 0, 1)
    std::map<std::string, TextureReference> textures;  ///< color, height, gloss, emissive, normal,
                                                       ///< layers, layers_2, layers_3,
                                                       ///< layer_normals_x, layer_normals_y,
                                                       ///< color_2, color_3, color_4
    std::optional<NoiseHeights> noise;                 ///< in place of the texture `height`
    Cull cull = Cull::none;
    float discard_below = -1;  ///< demote fragments whose colour alpha is below; < 0: never
};

struct Light {
    enum class Kind { point, directional };
    enum class Space { eye, world };
    Kind kind = Kind::point;
    Space space = Space::eye;        ///< eye, as the thesis has it: the light moves with the camera
    glm::vec3 position{10, 10, 10};  ///< or the direction towards the light
    glm::vec4 ambient{0.1f, 0.1f, 0.1f, 1}, diffuse{1, 1, 1, 1}, specular{1, 1, 1, 1};
    float intensity = 1;
    float constant_attenuation = 1, linear_attenuation = 0, quadratic_attenuation = 0;
};

/// A mesh in the world.
struct Object {
    std::string name;
    std::size_t mesh = 0, material = 0;  ///< indices into the scene's lists
    glm::mat4 transform{1.0f};           ///< object to world
    bool visible = true;
};

struct Scene {
    std::filesystem::path file;
    std::vector<std::string> overrides;  ///< "key=value", as load_scene was given them
    int width = 512, height = 512;
    int samples = 1;        ///< 1, 2, 4, 8 or 16 per pixel
    bool centroid = false;  ///< shade at the centroid instead of the centre under MSAA
    Conventions conventions = Conventions::gl;
    Hardware hardware = Hardware::exact;
    std::optional<DerivativeMode> derivatives;  ///< overrides the hardware's
    glm::vec4 background{0, 0, 0, 0};
    Camera camera;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Object> objects;
    std::vector<Light> lights;
    std::optional<Environment> environment;
    /// What is no error but should be known, such as what a mesh's file holds and is ignored: one
    /// printable line each. The command line prints them once, on standard error.
    std::vector<std::string> notes;
    std::string canonical;  ///< resolved JSON, paths replaced by content hashes
    std::string hash;       ///< SHA-256 of `canonical`, hex
    /// What renders of this scene and its copies have loaded and baked, for the next one: only
    /// files that have changed are read again. Another scene may be given the same; clear() frees
    /// memory. Never null.
    std::shared_ptr<TextureCache> texture_cache = std::make_shared<TextureCache>();
};

}  // namespace quadrel
