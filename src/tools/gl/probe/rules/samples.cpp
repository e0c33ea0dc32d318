#include "gl/probe/rules/samples.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <stdexcept>

#include "gl/context/program.hpp"
#include "gl/probe/rules/inputs.hpp"
#include "quadrel/raster/samples.hpp"
#include "quadrel/raster/triangle_quads.hpp"

namespace quadrel::gl {
namespace {

constexpr int sample_count = 4, sample_steps = 16;

/// Pixel k of a row of sample_steps: covered right of an edge from k / 16 of its width at the
/// bottom to (k + 1) / 16 at the top; of a column of sample_steps, above such an edge. Its ends lie
/// on any grid of sub-pixels, and no sample in between on the edge itself.
std::vector<Triangle> moving_edges(bool along_y) {
    const int width = along_y ? 1 : sample_steps, height = along_y ? sample_steps : 1;
    const auto at = [&](double x, double y) {
        return along_y ? corner(y, x, width, height) : corner(x, y, width, height);
    };
    std::vector<Triangle> triangles;
    for (int k = 0; k < sample_steps; ++k) {
        const Corner low = at(k + k / 16.0, 0), high = at(k + (k + 1) / 16.0, 1);
        const Corner low_end = at(k + 1, 0), high_end = at(k + 1, 1);
        triangles.push_back({low, low_end, high_end});
        triangles.push_back({low, high_end, high});
    }
    return triangles;
}

const char* const vertex_text =
    "#version 330 core\nin vec4 position;\n"
    "void main() { gl_Position = position; }\n";
const char* const drawn_text =
    "#version 330 core\nout vec4 color;\n"
    "void main() { color = vec4(1.0); }\n";

/// A picture of many samples a pixel, drawn and read sample by sample.
class SampledPicture {
  public:
    SampledPicture(int width, int height) : width_(width), height_(height) {
        glGenTextures(1, &texture_);
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, texture_);
        glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, sample_count, GL_RGBA8, width, height,
                                GL_TRUE);
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
        for (std::size_t i = 0; i < values.size() / 4; ++i) found += answer(values, i) != 0;
        return found;
    }

  private:
    int width_, height_;
    GLuint texture_ = 0, target_ = 0;
};

/// A sample at n / 16 lies past the edges of pixels 0 to n - 1.
Values seen_positions() {
    Values positions(2 * sample_count);
    for (const bool along_y : {false, true}) {
        SampledPicture picture(along_y ? 1 : sample_steps, along_y ? sample_steps : 1);
        picture.draw(moving_edges(along_y));
        for (int sample = 0; sample < sample_count; ++sample)
            positions[static_cast<std::size_t>(2 * sample + along_y)] =
                static_cast<float>(picture.count(sample));
    }
    return positions;
}

Values drawn_positions(const HardwareModel& hardware) {
    Values positions(2 * sample_count);
    for (const bool along_y : {false, true}) {
        const RasterState state =
            raster_state({along_y ? 1 : sample_steps, along_y ? sample_steps : 1}, hardware);
        for (const Triangle& triangle : moving_edges(along_y)) {
            std::array<glm::vec4, 3> clip;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto& p = triangle[i].position;
                clip[i] = glm::vec4(p[0], p[1], p[2], p[3]);
            }
            std::vector<AssembledTriangle> pieces;
            PrimitiveCounts counts;
            assemble_triangle(clip, state, pieces, counts);
            for (const AssembledTriangle& piece : pieces)
                for (int y = 0; y < state.viewport.height; ++y)
                    for (int x = 0; x < state.viewport.width; ++x) {
                        const int mask = coverage_mask(piece.screen, x, y, sample_count);
                        for (int sample = 0; sample < sample_count; ++sample)
                            positions[static_cast<std::size_t>(2 * sample + along_y)] +=
                                static_cast<float>((mask >> sample) & 1);
                    }
        }
    }
    return positions;
}

}  // namespace

Probe sample_positions_probe() {
    Probe probe{"samples", "where the samples of a pixel lie, of 4, in 1/16 pixel, by coverage",
                "anywhere (OpenGL 4.6, 14.3.1); Vulkan's standard positions: 6,2 14,6 2,10 10,14"};
    probe.seen = seen_positions;
    probe.model = drawn_positions;
    probe.words = [](const Values& values) {
        std::string text;
        for (std::size_t i = 0; i + 1 < values.size(); i += 2)
            text += fmt::format("{}{:.0f},{:.0f}", i == 0 ? "" : " ", values[i], values[i + 1]);
        return text;
    };
    return probe;
}

}  // namespace quadrel::gl
