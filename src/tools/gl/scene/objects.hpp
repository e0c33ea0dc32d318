// Objects of OpenGL that go with their owner.
#pragma once

#include <epoxy/gl.h>

#include <stdexcept>
#include <vector>

#include "gl/context/program.hpp"
#include "gl/scene/manifest.hpp"

namespace quadrel::gl {

/// A texture has more texels a side, or more layers, than the context takes.
struct TooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The vertices and indices of a scene; bound as long as it lives.
class SceneBuffers {
  public:
    explicit SceneBuffers(const ExportedScene& scene);
    ~SceneBuffers();
    SceneBuffers(const SceneBuffers&) = delete;
    SceneBuffers& operator=(const SceneBuffers&) = delete;

  private:
    GLuint array_ = 0, vertices_ = 0, indices_ = 0;
};

/// The textures of a scene, each level by its very bytes.
class SceneTextures {
  public:
    explicit SceneTextures(const ExportedScene& scene);
    ~SceneTextures();
    SceneTextures(const SceneTextures&) = delete;
    SceneTextures& operator=(const SceneTextures&) = delete;

    GLuint operator[](std::size_t texture) const { return ids_[texture]; }

  private:
    std::vector<GLuint> ids_;
};

/// Float targets and a depth buffer, of so many samples per pixel; bound as long as it lives.
/// Throws std::runtime_error where there are none such.
class FloatTargets {
  public:
    FloatTargets(int width, int height, std::size_t count, int samples = 1);
    ~FloatTargets();
    FloatTargets(const FloatTargets&) = delete;
    FloatTargets& operator=(const FloatTargets&) = delete;

    /// What is drawn goes here again.
    void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

    /// Textures of several samples (GL_TEXTURE_2D_MULTISAMPLE), or of one.
    GLuint color(std::size_t target) const { return textures_[target]; }
    GLuint depth() const { return textures_.back(); }

    /// Four floats per pixel of one target of one sample per pixel, window row 0 first.
    std::vector<float> read(std::size_t target) const;

  private:
    void attach(GLenum attachment, GLenum format, GLuint texture) const;

    int width_, height_, samples_;
    GLuint framebuffer_ = 0;
    std::vector<GLuint> textures_;  ///< colours, then depth
};

/// Reads textures of several samples per pixel, sample by sample, by drawing. Leaves depth test and
/// culling switched off, and its own framebuffer bound.
class SampleReader {
  public:
    SampleReader(int width, int height);
    ~SampleReader();
    SampleReader(const SampleReader&) = delete;
    SampleReader& operator=(const SampleReader&) = delete;

    /// Four floats per pixel of that sample, window row 0 first.
    std::vector<float> read(GLuint texture, int sample) const;

  private:
    Program program_;
    GLuint array_ = 0;
    FloatTargets target_;
};

}  // namespace quadrel::gl
