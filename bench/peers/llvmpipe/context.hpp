// A context of OpenGL without a window.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>

namespace quadrel::peers {

class Context {
  public:
    /// llvmpipe with so many threads, 0 for the caller's, without its cache of shaders. Made
    /// current. Throws std::runtime_error with the reason where that is not to be had.
    explicit Context(int threads);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    std::string description() const;

  private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace quadrel::peers
