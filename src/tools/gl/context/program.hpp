// Shaders, compiled and linked.
#pragma once

#include <epoxy/gl.h>

#include <string>

namespace quadrel::gl {

/// The program of these two texts; `what` names it. Throws std::runtime_error with the compiler's
/// message, beside which stands the line of the text that it is about.
GLuint make_program(const std::string& vertex, const std::string& fragment,
                    const std::string& what);

/// A compiler's message with the line of `text` that it names.
std::string explained(const std::string& message, const std::string& text);

/// A program that goes with its owner.
class Program {
  public:
    Program(const std::string& vertex, const std::string& fragment, const std::string& what);
    ~Program();
    Program(Program&& other) noexcept;
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    Program& operator=(Program&&) = delete;

    GLuint id() const { return id_; }

  private:
    GLuint id_;
};

}  // namespace quadrel::gl
