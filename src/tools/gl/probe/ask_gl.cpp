// The implementation's side. Numbers go in and come out as their bits, so that neither textures nor
// targets may change them.
#include <epoxy/gl.h>

#include <algorithm>
#include <stdexcept>

#include "gl/context/program.hpp"
#include "gl/context/sampler.hpp"
#include "gl/probe/ask_gl.hpp"
#include "rules/ask/shader_text.hpp"

namespace quadrel::gl {
namespace {

/// Units behind those of maps.
constexpr int numbers_unit = 14, target_unit = 15;

/// No newer than the question needs.
std::string version_line(const Question& question) {
    return "#version " + std::to_string(std::min(question.version, 40) * 10) + " core\n" +
           (question.version > 40 ? "#extension GL_ARB_derivative_control : require\n" : "");
}

struct Format {
    GLenum internal, external;
};

Format format_of(const ProbeTexture& map) {
    const bool one = map.channels == 1;
    switch (map.format) {
        case TexelFormat::unorm8:
            return {one ? GLenum(GL_R8) : GLenum(GL_RGBA8), one ? GLenum(GL_RED) : GLenum(GL_RGBA)};
        case TexelFormat::srgb8:
            return {GL_SRGB8_ALPHA8, GL_RGBA};
        case TexelFormat::unorm16:
            return {one ? GLenum(GL_R16) : GLenum(GL_RGBA16),
                    one ? GLenum(GL_RED) : GLenum(GL_RGBA)};
        case TexelFormat::half:
            return {one ? GLenum(GL_R16F) : GLenum(GL_RGBA16F),
                    one ? GLenum(GL_RED) : GLenum(GL_RGBA)};
        case TexelFormat::float32:
            break;
    }
    return {one ? GLenum(GL_R32F) : GLenum(GL_RGBA32F), one ? GLenum(GL_RED) : GLenum(GL_RGBA)};
}

/// What one question makes; gone with it.
class Objects {
  public:
    ~Objects() {
        glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
        glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
        glDeleteFramebuffers(1, &target);
        glDeleteVertexArrays(1, &vertices);
        glDeleteProgram(program);
    }
    GLuint texture() {
        textures_.push_back(0);
        glGenTextures(1, &textures_.back());
        return textures_.back();
    }
    GLuint buffer() {
        buffers_.push_back(0);
        glGenBuffers(1, &buffers_.back());
        return buffers_.back();
    }
    GLuint program = 0, target = 0, vertices = 0;

  private:
    std::vector<GLuint> textures_, buffers_;
};

void bind_map(Objects& objects, const ProbeTexture& map, int unit) {
    const GLenum target = map.cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target, objects.texture());
    const Format format = format_of(map);
    const int faces = map.cube ? 6 : 1;
    for (std::size_t level = 0; level < map.levels.size(); ++level)
        for (int face = 0; face < faces; ++face) {
            const int width = std::max(1, map.width >> level);
            const int height = std::max(1, map.height >> level);
            glTexImage2D(
                map.cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face) : target,
                static_cast<GLint>(level), static_cast<GLint>(format.internal), width, height, 0,
                format.external, GL_FLOAT,
                map.levels[level].data() +
                    static_cast<std::size_t>(face * width * height * map.channels));
        }
    set_sampler(target, map.sampler, static_cast<int>(map.levels.size()));
}

void bind_numbers(Objects& objects, const Question& question) {
    std::vector<std::array<float, 4>> numbers = question.asked;
    numbers.resize(static_cast<std::size_t>(question.width * question.height));
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(numbers_unit));
    glBindTexture(GL_TEXTURE_2D, objects.texture());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, question.width, question.height, 0, GL_RGBA_INTEGER,
                 GL_UNSIGNED_INT, numbers.data());
}

void bind_textures(Objects& objects, const Question& question) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    int unit = 0;
    for (const ProbeTexture& map : question.maps) {
        const std::string name = "map" + std::to_string(unit);
        glUniform1i(glGetUniformLocation(objects.program, name.c_str()), unit);
        bind_map(objects, map, unit++);
    }
    glUniform1i(glGetUniformLocation(objects.program, "numbers"), numbers_unit);
    bind_numbers(objects, question);
}

void bind_triangles(Objects& objects, const std::vector<Triangle>& triangles) {
    glGenVertexArrays(1, &objects.vertices);
    glBindVertexArray(objects.vertices);
    glBindBuffer(GL_ARRAY_BUFFER, objects.buffer());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(Triangle)),
                 triangles.data(), GL_STATIC_DRAW);
    const auto attribute = [&](const char* name, std::size_t offset) {
        const GLint location = glGetAttribLocation(objects.program, name);
        if (location < 0) return;
        glVertexAttribPointer(static_cast<GLuint>(location), 4, GL_FLOAT, GL_FALSE, sizeof(Corner),
                              reinterpret_cast<const void*>(offset));
        glEnableVertexAttribArray(static_cast<GLuint>(location));
    };
    attribute("position", offsetof(Corner, position));
    attribute("corner", offsetof(Corner, varying));
}

void make_target(Objects& objects, int width, int height) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(target_unit));
    const GLuint color = objects.texture();
    glBindTexture(GL_TEXTURE_2D, color);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32UI, width, height, 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                 nullptr);
    glGenFramebuffers(1, &objects.target);
    glBindFramebuffer(GL_FRAMEBUFFER, objects.target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
    glViewport(0, 0, width, height);
}

/// Draws `count` triangles from `first` on, and appends the frame.
void draw(const Question& question, std::size_t first, std::size_t count, Values& values) {
    const GLuint nothing[4] = {};
    glClearBufferuiv(GL_COLOR, 0, nothing);
    glDrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * first), static_cast<GLsizei>(3 * count));
    const std::size_t begin = values.size();
    values.resize(begin + static_cast<std::size_t>(4 * question.width * question.height));
    glReadPixels(0, 0, question.width, question.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                 values.data() + begin);
}

}  // namespace

Values ask_gl(const Question& question) {
    const std::vector<Triangle> triangles =
        question.triangles.empty() ? std::vector{rules::whole_frame()} : question.triangles;
    Objects objects;
    const std::string version = version_line(question);
    objects.program = make_program(rules::vertex_text(version),
                                   rules::fragment_text(question, version), "of a probe");
    glUseProgram(objects.program);
    make_target(objects, question.width, question.height);
    bind_textures(objects, question);
    bind_triangles(objects, triangles);
    Values values;
    const std::size_t count = question.apart ? 1 : triangles.size();
    for (std::size_t first = 0; first < triangles.size(); first += count)
        draw(question, first, count, values);
    if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL: error in a probe");
    return values;
}

Values answers_of_gl(const Probe& probe) {
    return probe.by_samples ? seen_sample_positions() : ask_gl(probe.question);
}

}  // namespace quadrel::gl
