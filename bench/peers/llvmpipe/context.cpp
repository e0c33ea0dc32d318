#include "llvmpipe/context.hpp"

#include <stdlib.h>

#include <stdexcept>

namespace quadrel::peers {
namespace {

/// Mesa reads these as a display is made.
void choose_llvmpipe(int threads) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    unsetenv("DISPLAY");
}

void require(bool condition, const char* what) {
    if (!condition) throw std::runtime_error(what);
}

std::string gl_string(GLenum name) { return reinterpret_cast<const char*>(glGetString(name)); }

}  // namespace

Context::Context(int threads) {
    choose_llvmpipe(threads);
    require(epoxy_has_egl(), "libEGL is not there");
    require(epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"),
            "EGL has no EGL_MESA_platform_surfaceless");
    display_ =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr),
            "EGL has no display");
    require(eglBindAPI(EGL_OPENGL_API), "EGL has no OpenGL");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                                 EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    require(context_ != EGL_NO_CONTEXT &&
                eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_),
            "EGL has no context of OpenGL 4.5");
    require(gl_string(GL_RENDERER).find("llvmpipe") != std::string::npos,
            "EGL's renderer is not llvmpipe");
}

Context::~Context() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string Context::description() const {
    return gl_string(GL_RENDERER) + ", OpenGL " + gl_string(GL_VERSION);
}

}  // namespace quadrel::peers
