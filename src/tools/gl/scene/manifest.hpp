// What an exported scene says of itself: its manifest.json, checked.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "quadrel/texture/format.hpp"

namespace quadrel::gl {

struct Uniform {
    std::string name;
    int components = 1;         ///< of a float, vec2, vec3 or vec4
    std::vector<float> values;  ///< of one element or of all of an array
};

struct VertexAttribute {
    std::string name;
    int location = 0, components = 1;
    std::size_t offset = 0;  ///< bytes
};

struct TextureLevel {
    int width = 1, height = 1;
    std::string bytes;  ///< as they are uploaded; face after face, layer after layer
};

struct ExportedTexture {
    std::string name;
    GLenum target = GL_TEXTURE_2D;  ///< or GL_TEXTURE_CUBE_MAP, GL_TEXTURE_2D_ARRAY
    int layers = 1;                 ///< of an array; the faces of a cube
    GLenum internal_format = GL_R32F, format = GL_RED, type = GL_FLOAT;
    std::vector<TextureLevel> levels;
};

struct ExportedSampler {
    std::string uniform;
    std::size_t texture = 0;
    SamplerState state;
};

struct ExportedMaterial {
    std::string name;
    std::string vertex, fragment;  ///< the shaders' texts
    std::string fragment_file;     ///< for messages
    std::optional<GLenum> cull;    ///< the face that is not drawn
    std::vector<ExportedSampler> samplers;
    std::vector<Uniform> uniforms;
};

struct Draw {
    std::string object;
    std::size_t material = 0, first_index = 0, index_count = 0;
    std::vector<Uniform> uniforms;
};

/// A component of a target.
struct TargetChannel {
    std::string name;  ///< empty: unused
    bool integer = false;
};

struct Target {
    std::array<float, 4> clear{};
    std::array<TargetChannel, 4> channels;
};

using Pass = std::vector<Target>;

/// An exported scene, with all that its files hold but for the expected channels.
struct ExportedScene {
    std::filesystem::path folder;
    std::string scene_file, scene_hash, language, hardware;
    std::vector<std::string> overrides;
    int width = 1, height = 1;
    int samples = 1;                               ///< of a pixel
    bool upper_left = false, zero_to_one = false;  ///< glClipControl
    bool first_row_is_top = false;                 ///< window row 0 is the image's top
    std::array<double, 2> depth_range{0, 1};
    GLenum depth_function = GL_LESS;
    double depth_clear = 1;
    GLenum front_face = GL_CCW;

    std::size_t stride = 0;
    std::vector<VertexAttribute> attributes;
    std::string vertices, indices;  ///< the buffers' bytes
    std::vector<ExportedTexture> textures;
    std::vector<ExportedMaterial> materials;
    std::vector<Uniform> uniforms;  ///< of the frame
    std::vector<Draw> draws;
    std::vector<Pass> passes;
};

/// Reads `folder`/manifest.json and the files that it names. Throws InputError for a folder that is
/// none that `quadrel export` has written, for a language that is not GLSL, for files that are
/// missing or of another length, and for what cannot be drawn: no pass, indices that no vertex has,
/// levels that are no mip levels.
ExportedScene read_exported_scene(const std::filesystem::path& folder);

}  // namespace quadrel::gl
