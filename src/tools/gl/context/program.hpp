// Shaders, compiled and linked.
#pragma once

#include <epoxy/gl.h>

#include <string>

namespace quadrel::gl {

/// The program of these two texts; `what` names it. Throws std::runtime_error with the compiler's
/// message.
GLuint make_program(const std::string& vertex, const std::string& fragment,
                    const std::string& what);

}  // namespace quadrel::gl
