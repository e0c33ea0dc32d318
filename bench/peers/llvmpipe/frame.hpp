// A frame that OpenGL draws: target, quad, textures, uniforms.
#pragma once

#include "gl/context/context.hpp"
#include "llvmpipe/llvmpipe.hpp"

namespace quadrel::peers {

/// In the current context, which must outlive it.
class GlFrame : public ShadedFrame {
  public:
    GlFrame(const Row& row, const Scene& scene, const std::vector<std::string>& defines);
    ~GlFrame() override;

    void draw() override;
    std::vector<float> read() override;

  private:
    void make_target();
    void make_depth(const Scene& scene);
    void make_mesh(const Scene& scene);
    void bind_textures(const Scene& scene);
    void set_uniforms(const Scene& scene);
    void attribute(const char* name, int components, const void* values, std::size_t bytes);
    GLint uniform(const char* name) const { return glGetUniformLocation(program_, name); }

    int width_, height_, indices_ = 0;
    GLuint program_ = 0, target_ = 0, color_ = 0, depth_ = 0, mesh_ = 0;
    std::vector<GLuint> textures_, buffers_;
};

}  // namespace quadrel::peers
