// Shaders from files, compiled and linked.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace quadrel::peers {

/// The program of vertex.glsl and of the files of shaders/, one after the other, after `defines`.
/// Throws std::runtime_error for files that are missing and with the compiler's message.
GLuint make_program(const std::vector<std::string>& files, const std::vector<std::string>& defines);

}  // namespace quadrel::peers
