#include "rules/probes/samples.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <stdexcept>

#include "gl/context/program.hpp"
#include "gl/probe/ask_gl.hpp"

namespace quadrel::gl {
namespace {

const char* const vertex_text =
    "#version 330 core\nin vec4 position;\n"
    "void main() { gl_Position = position; }\n";
const char* const drawn_text =
    "#version 330 core\nout vec4 color;\n"
    "void main() { color = vec4(1.0); }\n";

/// A picture of many samples per pixel, drawn and read sample by sample.
class SampledPicture {
  public:
    SampledPicture(int width, int height) : width_(width), height_(height) {
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture_);
        glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, rules::sample_count, GL_RGBA8, width,
                                height, GL_TRUE);
        glGenFramebuffers(1, &target_);
        glBindFramebuffer(GL_FRAMEBUFFER, target_);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                               texture_, 0);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error("no target of 4 samples");
        glViewport(0, 0, width, height);
    }
    ~SampledPicture() {
        glDeleteFramebuffers(1, &target_);
        glDeleteTextures(1, &texture_);
    }
    SampledPicture(const SampledPicture&) = delete;
    SampledPicture& operator=(const SampledPicture&) = delete;

    void draw(const std::vector<Triangle>& triangles) {
        glEnable(GL_MULTISAMPLE);
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        const GLuint program = make_program(vertex_text, drawn_text, "of samples");
        glUseProgram(program);
        GLuint array = 0, buffer = 0;
        glGenVertexArrays(1, &array);
        glBindVertexArray(array);
        glGenBuffers(1, &buffer);
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(Triangle)),
                     triangles.data(), GL_STATIC_DRAW);
        const auto position = static_cast<GLuint>(glGetAttribLocation(program, "position"));
        glVertexAttribPointer(position, 4, GL_FLOAT, GL_FALSE, sizeof(Corner), nullptr);
        glEnableVertexAttribArray(position);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles.size()));
        glDeleteBuffers(1, &buffer);
        glDeleteVertexArrays(1, &array);
        glDeleteProgram(program);
    }

    /// How many pixels of the picture have the sample.
    int count(int sample) const {
        Question question{width_, height_};
        question.glsl = fmt::format(
            "    return vec4(texelFetch(picture, ivec2(pixel), {}).x, 0.0, 0.0, 1.0);", sample);
        question.uniforms = "uniform sampler2DMS picture;\n";
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture_);
        const Values values = ask_gl(question);
        int found = 0;
        for (std::size_t i = 0; i < values.size() / 4; ++i) found += values[4 * i] != 0;
        return found;
    }

  private:
    int width_, height_;
    GLuint texture_ = 0, target_ = 0;
};

}  // namespace

Values seen_sample_positions() {
    Values positions(2 * rules::sample_count);
    for (const bool along_y : {false, true}) {
        SampledPicture picture(along_y ? 1 : rules::sample_steps,
                               along_y ? rules::sample_steps : 1);
        picture.draw(rules::moving_edges(along_y));
        // A sample at n / 16 lies past the edges of pixels 0 to n - 1.
        for (int sample = 0; sample < rules::sample_count; ++sample)
            positions[static_cast<std::size_t>(2 * sample + along_y)] =
                static_cast<float>(picture.count(sample));
    }
    return positions;
}

}  // namespace quadrel::gl
