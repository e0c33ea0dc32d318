#include "llvmpipe/frame.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

#include "llvmpipe/program.hpp"
#include "llvmpipe/textures.hpp"

namespace quadrel::peers {
namespace {

std::vector<std::string> all_defines(const Row& row, std::vector<std::string> defines) {
    defines.insert(defines.end(), row.defines.begin(), row.defines.end());
    return defines;
}

glm::vec3 product(const glm::vec4& a, const glm::vec4& b) { return glm::vec3(a * b); }

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

}  // namespace

GlFrame::GlFrame(const Row& row, const Scene& scene, const std::vector<std::string>& defines)
    : width_(scene.width),
      height_(scene.height),
      program_(make_program(row.shaders, all_defines(row, defines))) {
    glUseProgram(program_);
    make_target();
    make_depth(scene);
    make_mesh(scene);
    bind_textures(scene);
    set_uniforms(scene);
    if (glGetError() != GL_NO_ERROR)
        throw std::runtime_error("OpenGL: error in setting up a frame");
}

GlFrame::~GlFrame() {
    glDeleteFramebuffers(1, &target_);
    glDeleteTextures(1, &color_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
    glDeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
    glDeleteVertexArrays(1, &mesh_);
    glDeleteProgram(program_);
}

void GlFrame::make_target() {
    glGenTextures(1, &color_);
    glBindTexture(GL_TEXTURE_2D, color_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width_, height_, 0, GL_RGBA, GL_FLOAT, nullptr);
    glGenFramebuffers(1, &target_);
    glBindFramebuffer(GL_FRAMEBUFFER, target_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
    glViewport(0, 0, width_, height_);
}

/// For meshes that may lie in front of themselves.
void GlFrame::make_depth(const Scene& scene) {
    glDisable(GL_DEPTH_TEST);
    if (scene.meshes.at(scene.objects.at(0).mesh).triangles.size() <= 2) return;
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    glEnable(GL_DEPTH_TEST);
}

void GlFrame::attribute(const char* name, int components, const void* values, std::size_t bytes) {
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    buffers_.push_back(buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), values, GL_STATIC_DRAW);
    const GLint location = glGetAttribLocation(program_, name);
    if (location < 0) return;
    const auto index = static_cast<GLuint>(location);
    glVertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(index);
}

void GlFrame::make_mesh(const Scene& scene) {
    const Mesh& mesh = scene.meshes.at(scene.objects.at(0).mesh);
    glGenVertexArrays(1, &mesh_);
    glBindVertexArray(mesh_);
    attribute("position", 3, mesh.positions.data(), bytes_of(mesh.positions));
    attribute("normal", 3, mesh.normals.data(), bytes_of(mesh.normals));
    attribute("mesh_uv", 2, mesh.uvs.data(), bytes_of(mesh.uvs));
    GLuint triangles = 0;
    glGenBuffers(1, &triangles);
    buffers_.push_back(triangles);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes_of(mesh.triangles)),
                 mesh.triangles.data(), GL_STATIC_DRAW);
    indices_ = static_cast<int>(3 * mesh.triangles.size());
}

void GlFrame::bind_textures(const Scene& scene) {
    const auto bind = [&](const char* name, GLenum target, const auto& make) {
        const GLint location = uniform(name);
        if (location < 0) return;
        const auto unit = static_cast<int>(textures_.size());
        glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        textures_.push_back(make());
        glBindTexture(target, textures_.back());
        glUniform1i(location, unit);
    };
    bind("color_map", GL_TEXTURE_2D, [&] { return material_texture(scene, "color"); });
    bind("height_map", GL_TEXTURE_2D, [&] { return material_texture(scene, "height"); });
    bind("gloss_map", GL_TEXTURE_2D, [&] { return material_texture(scene, "gloss"); });
    bind("max_map", GL_TEXTURE_2D, [&] { return max_pyramid(scene); });
    bind("environment_map", GL_TEXTURE_CUBE_MAP, [&] { return environment_texture(scene); });
}

void GlFrame::set_uniforms(const Scene& scene) {
    const auto matrix = [&](const char* name, const glm::mat4& m) {
        glUniformMatrix4fv(uniform(name), 1, GL_FALSE, glm::value_ptr(m));
    };
    const auto vector = [&](const char* name, const glm::vec3& v) {
        glUniform3fv(uniform(name), 1, glm::value_ptr(v));
    };
    const Material& material = scene.materials.at(0);
    const Light& light = scene.lights.at(0);
    const glm::mat4 to_eye = scene.camera.view * scene.objects.at(0).transform;
    const glm::mat3 normals = transpose(inverse(glm::mat3(to_eye)));
    matrix("to_eye", to_eye);
    matrix("projection", scene.camera.projection);
    matrix("texture_matrix", material.texture_matrix);
    glUniformMatrix3fv(uniform("normal_to_eye"), 1, GL_FALSE, glm::value_ptr(normals));
    glUniform1f(uniform("relief_depth"), material.depth);
    vector("light_position", light.position);
    vector("light_ambient", glm::vec3(light.ambient));
    vector("ambient", product(light.ambient, material.ambient));
    vector("diffuse", product(light.diffuse, material.diffuse));
    vector("specular", product(light.specular, material.specular));
}

void GlFrame::draw() {
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
    glFinish();
}

std::vector<float> GlFrame::read() {
    const auto row = static_cast<std::size_t>(4 * width_);
    std::vector<float> bottom_up(row * static_cast<std::size_t>(height_)), pixels;
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, bottom_up.data());
    pixels.reserve(bottom_up.size());
    for (std::size_t y = static_cast<std::size_t>(height_); y-- > 0;)
        pixels.insert(pixels.end(), bottom_up.begin() + static_cast<std::ptrdiff_t>(y * row),
                      bottom_up.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
    return pixels;
}

}  // namespace quadrel::peers
