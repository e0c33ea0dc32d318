#include "gl/context/program.hpp"

#include <cctype>
#include <stdexcept>
#include <utility>
#include <vector>

namespace quadrel::gl {
namespace {

/// The line, from 1 on, that a compiler's message is about: 0:LINE of Mesa and ANGLE, 0(LINE) of
/// NVIDIA; 0 where it names none.
std::size_t line_of(const std::string& message) {
    for (std::size_t at = 0; (at = message.find('0', at)) != std::string::npos; ++at) {
        const bool begins =
            at == 0 || std::isalnum(static_cast<unsigned char>(message[at - 1])) == 0;
        if (!begins || at + 2 >= message.size() ||
            (message[at + 1] != ':' && message[at + 1] != '('))
            continue;
        std::size_t line = 0;
        for (std::size_t i = at + 2;
             i < message.size() && std::isdigit(static_cast<unsigned char>(message[i])) != 0; ++i)
            line = 10 * line + static_cast<std::size_t>(message[i] - '0');
        if (line > 0) return line;
    }
    return 0;
}

std::string line_at(const std::string& text, std::size_t line) {
    std::size_t begin = 0;
    for (; line > 1 && begin != std::string::npos; --line) {
        begin = text.find('\n', begin);
        if (begin != std::string::npos) ++begin;
    }
    if (begin == std::string::npos) return "";
    return text.substr(begin, text.find('\n', begin) - begin);
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
    glDeleteShader(shader);
    throw std::runtime_error((kind == GL_VERTEX_SHADER ? "vertex shader " : "fragment shader ") +
                             what + ": " + explained(message, text));
}

}  // namespace

std::string explained(const std::string& message, const std::string& text) {
    std::string all = message;
    while (!all.empty() && std::isspace(static_cast<unsigned char>(all.back())) != 0)
        all.pop_back();
    const std::size_t line = line_of(message);
    if (line == 0) return all;
    return all + "\n  line " + std::to_string(line) + ": " + line_at(text, line);
}

Program::Program(const std::string& vertex, const std::string& fragment, const std::string& what)
    : id_(make_program(vertex, fragment, what)) {}

Program::Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}

Program::~Program() { glDeleteProgram(id_); }

GLuint make_program(const std::string& vertex, const std::string& fragment,
                    const std::string& what) {
    const GLuint program = glCreateProgram();
    try {
        for (const auto& [kind, text] :
             {std::pair<GLenum, const std::string&>(GL_VERTEX_SHADER, vertex),
              {GL_FRAGMENT_SHADER, fragment}}) {
            const GLuint shader = compiled(kind, text, what);
            glAttachShader(program, shader);
            glDeleteShader(shader);
        }
    } catch (...) {
        glDeleteProgram(program);
        throw;
    }
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok != 0) return program;
    char message[2000] = "";
    glGetProgramInfoLog(program, sizeof(message), nullptr, message);
    glDeleteProgram(program);
    throw std::runtime_error("shaders " + what + " do not link: " + message);
}

}  // namespace quadrel::gl
