// Objects of OpenGL that go with their owner.
#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "gl/scene/manifest.hpp"

namespace quadrel::gl {

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

/// Float targets and a depth buffer; bound as long as it lives.
class FloatTargets {
  public:
    FloatTargets(int width, int height, std::size_t count);
    ~FloatTargets();
    FloatTargets(const FloatTargets&) = delete;
    FloatTargets& operator=(const FloatTargets&) = delete;

    /// Four floats a pixel of one target, window row 0 first.
    std::vector<float> read(std::size_t target) const;

  private:
    int width_, height_;
    GLuint framebuffer_ = 0, depth_ = 0;
    std::vector<GLuint> colors_;
};

}  // namespace quadrel::gl
