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

void upload(const ExportedTexture& texture) {
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

FloatTargets::FloatTargets(int width, int height, std::size_t count)
    : width_(width), height_(height), colors_(count, 0) {
    glGenFramebuffers(1, &framebuffer_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glGenRenderbuffers(static_cast<GLsizei>(count), colors_.data());
    std::vector<GLenum> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
        glBindRenderbuffer(GL_RENDERBUFFER, colors_[i]);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, places.back(), GL_RENDERBUFFER, colors_[i]);
    }
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    glDrawBuffers(static_cast<GLsizei>(count), places.data());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error(
            fmt::format("OpenGL has no {} float targets of {}x{} pixels", count, width, height));
    glViewport(0, 0, width, height);
}

FloatTargets::~FloatTargets() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(static_cast<GLsizei>(colors_.size()), colors_.data());
    glDeleteRenderbuffers(1, &depth_);
}

std::vector<float> FloatTargets::read(std::size_t target) const {
    std::vector<float> values(4 * static_cast<std::size_t>(width_) *
                              static_cast<std::size_t>(height_));
    glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(target));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, values.data());
    return values;
}

}  // namespace quadrel::gl
