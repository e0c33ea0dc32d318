#include "export/scene/uniforms.hpp"

#include <fmt/format.h>

#include <glm/matrix.hpp>

#include "render/draw/vertex_stage.hpp"

namespace quadrel {
namespace {

template <std::size_t n>
std::vector<float> list(const float (&values)[n]) {
    return {values, values + n};
}

/// By rows.
template <class Matrix>
std::vector<float> rows_of(const Matrix& m) {
    std::vector<float> values;
    for (glm::length_t row = 0; row < Matrix::length(); ++row)
        for (glm::length_t column = 0; column < Matrix::length(); ++column)
            values.push_back(m[column][row]);
    return values;
}

}  // namespace

UniformValues frame_values_by_name(const FrameUniforms& frame) {
    UniformValues values{{"eye", list(frame.eye)},
                         {"eye_to_world", list(frame.eye_to_world)},
                         {"projection", list(frame.projection)},
                         {"depth_scale", {frame.depth_scale}},
                         {"depth_offset", {frame.depth_offset}}};
    for (int i = 0; i < frame.light_count; ++i) {
        const LightUniforms& light = frame.lights[i];
        const auto name = [&](const char* what) { return fmt::format("light{}_{}", i, what); };
        values[name("position")] = list(light.position);
        values[name("ambient")] = list(light.ambient);
        values[name("diffuse")] = list(light.diffuse);
        values[name("specular")] = list(light.specular);
        values[name("intensity")] = {light.intensity};
        values[name("constant")] = {light.attenuation[0]};
        values[name("linear")] = {light.attenuation[1]};
        values[name("quadratic")] = {light.attenuation[2]};
    }
    return values;
}

UniformValues material_values_by_name(const Material& material) {
    return {{"texture_matrix", rows_of(material.texture_matrix)}};
}

UniformValues object_values_by_name(const Scene& scene, const Object& object) {
    const glm::mat4 model_view = scene.camera.view * object.transform;
    const bool flat = scene.meshes[object.mesh].normals.empty();
    // As vertex programs have it (render/draw/primitive_vertices).
    const glm::mat4 to_object(glm::inverse(glm::dmat4(model_view)));
    return {{"model_view", rows_of(model_view)},
            {"inverse_model_view", rows_of(to_object)},
            {"normal_matrix", rows_of(normal_matrix(model_view))},
            {"flat_faces", {flat ? 1.0f : 0.0f}}};
}

}  // namespace quadrel
