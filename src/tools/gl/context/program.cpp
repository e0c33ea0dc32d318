#include "gl/context/program.hpp"

#include <stdexcept>

namespace quadrel::gl {
namespace {

GLuint compiled(GLenum kind, const std::string& text, const std::string& what) {
    const GLuint shader = glCreateShader(kind);
    const char* const start = text.c_str();
    glShaderSource(shader, 1, &start, nullptr);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok != 0) return shader;
    char message[2000] = "";
    glGetShaderInfoLog(shader, sizeof(message), nullptr, message);
    throw std::runtime_error("shaders " + what + ": " + message);
}

}  // namespace

GLuint make_program(const std::string& vertex, const std::string& fragment,
                    const std::string& what) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader :
         {compiled(GL_VERTEX_SHADER, vertex, what), compiled(GL_FRAGMENT_SHADER, fragment, what)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == 0) throw std::runtime_error("shaders " + what + " do not link");
    return program;
}

}  // namespace quadrel::gl
