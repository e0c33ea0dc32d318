#include "gl/scene/objects.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace quadrel::gl {
namespace {

GLuint make_buffer(GLenum target, const std::string& bytes) {
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    return buffer;
}

void upload_level(const ExportedTexture& texture, GLint level) {
    const TextureLevel& texels = texture.levels[static_cast<std::size_t>(level)];
    const auto format = static_cast<GLint>(texture.internal_format);
    const char* const bytes = texels.bytes.data();
    if (texture.target == GL_TEXTURE_2D_ARRAY)
        return glTexImage3D(texture.target, level, format, texels.width, texels.height,
                            texture.layers, 0, texture.format, texture.type, bytes);
    const std::size_t a_face = texels.bytes.size() / static_cast<std::size_t>(texture.layers);
    for (int face = 0; face < texture.layers; ++face)
        glTexImage2D(texture.target == GL_TEXTURE_CUBE_MAP
                         ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face)
                         : texture.target,
                     level, format, texels.width, texels.height, 0, texture.format, texture.type,
                     bytes + static_cast<std::size_t>(face) * a_face);
}

GLint limit(GLenum name) {
    GLint most = 0;
    glGetIntegerv(name, &most);
    return most;
}

/// Without it such a texture would be read as black.
void check_size(const ExportedTexture& texture) {
    const TextureLevel& finest = texture.levels.front();
    const GLint side = limit(texture.target == GL_TEXTURE_CUBE_MAP ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                                                                   : GL_MAX_TEXTURE_SIZE);
    const GLint layers =
        texture.target == GL_TEXTURE_2D_ARRAY ? limit(GL_MAX_ARRAY_TEXTURE_LAYERS) : texture.layers;
    if (finest.width > side || finest.height > side || texture.layers > layers)
        throw TooLarge(
            fmt::format("texture {}: found {}x{}, {} layers, expected at most {} a side "
                        "and {} layers, which this OpenGL takes",
                        texture.name, finest.width, finest.height, texture.layers, side, layers));
}

void upload(const ExportedTexture& texture) {
    check_size(texture);
    const auto levels = static_cast<GLint>(texture.levels.size());
    for (GLint level = 0; level < levels; ++level) upload_level(texture, level);
    glTexParameteri(texture.target, GL_TEXTURE_MAX_LEVEL, levels - 1);
}

}  // namespace

SceneBuffers::SceneBuffers(const ExportedScene& scene) {
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    vertices_ = make_buffer(GL_ARRAY_BUFFER, scene.vertices);
    indices_ = make_buffer(GL_ELEMENT_ARRAY_BUFFER, scene.indices);
    for (const VertexAttribute& attribute : scene.attributes) {
        const auto location = static_cast<GLuint>(attribute.location);
        glVertexAttribPointer(location, attribute.components, GL_FLOAT, GL_FALSE,
                              static_cast<GLsizei>(scene.stride),
                              reinterpret_cast<const void*>(attribute.offset));
        glEnableVertexAttribArray(location);
    }
}

SceneBuffers::~SceneBuffers() {
    glDeleteBuffers(1, &vertices_);
    glDeleteBuffers(1, &indices_);
    glDeleteVertexArrays(1, &array_);
}

SceneTextures::SceneTextures(const ExportedScene& scene) : ids_(scene.textures.size(), 0) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glGenTextures(static_cast<GLsizei>(ids_.size()), ids_.data());
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        glBindTexture(scene.textures[i].target, ids_[i]);
        upload(scene.textures[i]);
    }
}

SceneTextures::~SceneTextures() {
    glDeleteTextures(static_cast<GLsizei>(ids_.size()), ids_.data());
}

FloatTargets::FloatTargets(int width, int height, std::size_t count, int samples)
    : width_(width), height_(height), samples_(samples), textures_(count + 1, 0) {
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glGenTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    std::vector<GLenum> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        attach(places.back(), GL_RGBA32F, color(i));
    }
    attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, depth());
    glDrawBuffers(static_cast<GLsizei>(count), places.data());
    GLint has = 0;
    glGetIntegerv(GL_SAMPLES, &has);
    while (glGetError() != GL_NO_ERROR) {
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE ||
        (samples > 1 && has != samples))
        throw std::runtime_error(
            fmt::format("OpenGL has no {} float targets of {}x{} pixels{}", count, width, height,
                        samples > 1 ? fmt::format(" of {} samples", samples) : std::string()));
    glViewport(0, 0, width, height);
}

void FloatTargets::attach(GLenum attachment, GLenum format, GLuint texture) const {
    const GLenum target = samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
    glBindTexture(target, texture);
    if (samples_ > 1)
        glTexImage2DMultisample(target, samples_, format, width_, height_, GL_TRUE);
    else
        glTexImage2D(target, 0, static_cast<GLint>(format), width_, height_, 0,
                     attachment == GL_DEPTH_ATTACHMENT ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT,
                     nullptr);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, target, texture, 0);
    glBindTexture(target, 0);
}

FloatTargets::~FloatTargets() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
}

std::vector<float> FloatTargets::read(std::size_t target) const {
    std::vector<float> values(4 * static_cast<std::size_t>(width_) *
                              static_cast<std::size_t>(height_));
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(target));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, values.data());
    return values;
}

namespace {

constexpr const char* whole_frame = R"(#version 330 core
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";

constexpr const char* one_sample = R"(#version 330 core
uniform sampler2DMS samples;
uniform int number;
out vec4 value;
void main() {
    value = texelFetch(samples, ivec2(gl_FragCoord.xy), number);
}
)";

}  // namespace

SampleReader::SampleReader(int width, int height)
    : program_(whole_frame, one_sample, "that reads samples"), target_(width, height, 1) {
    glGenVertexArrays(1, &array_);
}

SampleReader::~SampleReader() { glDeleteVertexArrays(1, &array_); }

std::vector<float> SampleReader::read(GLuint texture, int sample) const {
    GLint before = 0;
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &before);
    target_.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glUseProgram(program_.id());
    glBindVertexArray(array_);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture);
    glUniform1i(glGetUniformLocation(program_.id(), "samples"), 0);
    glUniform1i(glGetUniformLocation(program_.id(), "number"), sample);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, 0);
    glUseProgram(0);
    glBindVertexArray(static_cast<GLuint>(before));
    return target_.read(0);
}

}  // namespace quadrel::gl
