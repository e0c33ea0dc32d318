// A context of OpenGL without a window.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <string>

namespace quadrel::gl {

class Context {
  public:
    /// The newest core profile, 3.3 at least, of the implementation at hand: the first device that
    /// is no software, else what EGL gives without a display; Mesa's variables choose among its
    /// drivers (LIBGL_ALWAYS_SOFTWARE, MESA_LOADER_DRIVER_OVERRIDE). Without Mesa's cache of
    /// shaders. Made current. Throws std::runtime_error with the reason where none is to be had.
    static Context at_hand();
    /// llvmpipe with so many threads, 0 for the caller's.
    static Context llvmpipe(int threads);

    ~Context();
    Context(Context&& other) noexcept;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// On this thread, in the place of any other; and on none. A thread that draws beside others
    /// has a context of its own.
    void make_current() const;
    void release() const;

    /// 33, 40, ..., 46.
    int version() const { return epoxy_gl_version(); }
    /// Renderer and version, as the implementation names them.
    std::string description() const;

  private:
    Context() = default;
    std::string try_display(EGLDisplay display);

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// glGetString, "" where there is none.
std::string gl_string(GLenum name);

}  // namespace quadrel::gl
