#include "gl/context/context.hpp"

#include <stdlib.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace quadrel::gl {
namespace {

/// Mesa reads these as a display is made.
void choose_llvmpipe(int threads) {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
    unsetenv("MESA_LOADER_DRIVER_OVERRIDE");
    unsetenv("DISPLAY");
}

/// Whether the user has asked Mesa for a driver, which its display without a surface heeds.
bool mesa_is_told() {
    return getenv("LIBGL_ALWAYS_SOFTWARE") != nullptr ||
           getenv("MESA_LOADER_DRIVER_OVERRIDE") != nullptr || getenv("GALLIUM_DRIVER") != nullptr;
}

bool has_extension(const char* name) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, name); }

EGLDisplay surfaceless_display() {
    if (!has_extension("EGL_MESA_platform_surfaceless")) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

bool is_software(EGLDeviceEXT device) {
    const char* const names = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return names != nullptr &&
           std::string(names).find("EGL_MESA_device_software") != std::string::npos;
}

/// Of devices that are no software.
std::vector<EGLDisplay> device_displays() {
    std::vector<EGLDisplay> displays;
    if (!has_extension("EGL_EXT_platform_device") || !has_extension("EGL_EXT_device_enumeration"))
        return displays;
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (!eglQueryDevicesEXT(16, devices, &count)) return displays;
    for (EGLint i = 0; i < count; ++i)
        if (!is_software(devices[i]))
            displays.push_back(
                eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    return displays;
}

EGLContext newest_context(EGLDisplay display) {
    for (const int version : {46, 45, 44, 43, 42, 41, 40, 33}) {
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     version / 10,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     version % 10,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        const EGLContext context =
            eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (context != EGL_NO_CONTEXT) return context;
    }
    return EGL_NO_CONTEXT;
}

}  // namespace

std::string gl_string(GLenum name) {
    const auto* const text = reinterpret_cast<const char*>(glGetString(name));
    return text == nullptr ? "" : text;
}

std::string Context::try_display(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
        return "EGL has no display";
    display_ = display;
    if (!eglBindAPI(EGL_OPENGL_API)) return "EGL has no OpenGL";
    context_ = newest_context(display);
    if (context_ == EGL_NO_CONTEXT ||
        !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        return "EGL has no context of OpenGL 3.3";
    return "";
}

Context Context::at_hand() {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    if (!epoxy_has_egl()) throw std::runtime_error("libEGL is not there");
    std::vector<EGLDisplay> displays = device_displays();
    displays.insert(mesa_is_told() ? displays.begin() : displays.end(), surfaceless_display());
    displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    std::string reason;
    for (const EGLDisplay display : displays) {
        Context context;
        const std::string failure = context.try_display(display);
        if (failure.empty()) return context;
        if (reason.empty()) reason = failure;
    }
    throw std::runtime_error(reason);
}

Context Context::llvmpipe(int threads) {
    choose_llvmpipe(threads);
    Context context = at_hand();
    if (gl_string(GL_RENDERER).find("llvmpipe") == std::string::npos)
        throw std::runtime_error("EGL's renderer is not llvmpipe");
    return context;
}

Context::Context(Context&& other) noexcept
    : display_(std::exchange(other.display_, EGL_NO_DISPLAY)),
      context_(std::exchange(other.context_, EGL_NO_CONTEXT)) {}

void Context::make_current() const {
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        throw std::runtime_error("EGL's context cannot be made current");
}

void Context::release() const {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

Context::~Context() {
    if (display_ == EGL_NO_DISPLAY) return;
    if (eglGetCurrentContext() == context_) release();
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string Context::description() const {
    return gl_string(GL_RENDERER) + ", OpenGL " + gl_string(GL_VERSION);
}

}  // namespace quadrel::gl
