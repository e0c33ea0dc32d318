#include "llvmpipe/program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace quadrel::peers {
namespace {

std::string text_of(const std::string& name) {
    const std::string path = fmt::format("{}/{}.glsl", QUADREL_PEERS_SHADERS, name);
    std::ifstream in(path);
    if (!in) throw std::runtime_error(path + ": cannot be read");
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string head(const std::vector<std::string>& defines) {
    std::string text = "#version 450 core\n";
    for (const std::string& define : defines) text += "#define " + define + "\n";
    return text;
}

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
    throw std::runtime_error(fmt::format("shaders {}: {}", what, message));
}

}  // namespace

GLuint make_program(const std::vector<std::string>& files,
                    const std::vector<std::string>& defines) {
    std::string fragment = head(defines);
    for (const std::string& file : files) fragment += text_of(file);
    const std::string what = fmt::format("{}", fmt::join(files, ", "));
    const GLuint program = glCreateProgram();
    glAttachShader(program, compiled(GL_VERTEX_SHADER, head({}) + text_of("vertex"), "vertex"));
    glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment, what));
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok == 0) throw std::runtime_error("shaders " + what + " do not link");
    return program;
}

}  // namespace quadrel::peers
