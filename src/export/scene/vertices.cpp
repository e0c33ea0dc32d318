#include "export/scene/vertices.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include "render/draw/vertex_stage.hpp"
#include "scene/billboard.hpp"

namespace quadrel {
namespace {

/// Indices of vertices by their bytes.
using Known = std::map<std::string, std::uint32_t>;

class Builder {
  public:
    Builder(const Scene& scene, const std::vector<std::string>& names) : scene_(scene) {
        int offset = 0;
        for (VertexAttribute attribute : all_vertex_attributes()) {
            if (std::find(names.begin(), names.end(), attribute.name) == names.end()) continue;
            attribute.offset = offset;
            fits_quadrics_ |= std::string_view(attribute.name) == "curvature";
            offset += attribute.components * static_cast<int>(sizeof(float));
            buffers_.attributes.push_back(attribute);
        }
    }

    void add(std::size_t object) {
        Draw draw{object, static_cast<std::uint32_t>(buffers_.indices.size())};
        const Object& of = scene_.objects[object];
        Mesh card;
        const Mesh& mesh = drawn_mesh(scene_, of, card);
        const Material& material = scene_.materials[of.material];
        const glm::mat4 model_view = scene_.camera.view * of.transform;
        const ShadedVertices shaded =
            shade_vertices(mesh, scene_.camera, model_view, material.texture_matrix);
        const PrimitiveFrames frames(mesh, model_view, shaded.eye, shaded.uv, material.frame.id,
                                     fits_quadrics_);
        const bool mirrored = is_mirrored(model_view);
        Known known;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            add_triangle(mesh, shaded, frames, drawn_corners(t, mirrored), known);
        draw.index_count = static_cast<std::uint32_t>(buffers_.indices.size()) - draw.first_index;
        buffers_.draws.push_back(draw);
    }

    VertexBuffers take() { return std::move(buffers_); }

  private:
    void add_triangle(const Mesh& mesh, const ShadedVertices& shaded, const PrimitiveFrames& frames,
                      const DrawnCorners& drawn, Known& known) {
        const auto index = indices_of(mesh, drawn);
        const auto& eye = shaded.eye;
        if (is_flat(eye[index[0]], eye[index[1]], eye[index[2]])) return;
        const glm::vec3 face = face_normal(eye[index[0]], eye[index[1]], eye[index[2]]);
        // The whole triangle: its vertices are the mesh's own.
        AssembledTriangle whole;
        for (std::size_t v = 0; v < 3; ++v) whole.weights[v].perspective[v] = 1;
        const PrimitiveFrame frame = frames.of(whole, drawn);
        for (int v = 0; v < 3; ++v) {
            const std::uint32_t i = index[static_cast<std::size_t>(v)];
            const glm::vec3 normal = mesh.normals.empty() ? glm::vec3(0) : mesh.normals[i];
            const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[i];
            const glm::vec3 eye_normal = mesh.normals.empty() ? face : shaded.normal[i];
            // In the order of all_vertex_attributes.
            const float* const parts[] = {&mesh.positions[i].x,
                                          &normal.x,
                                          &uv.x,
                                          &face.x,
                                          frame.tangent[v],
                                          &frame.tangent_sign[v],
                                          frame.bitangent[v],
                                          frame.J,
                                          frame.J + 3,
                                          &eye[i].x,
                                          &shaded.clip[i].x,
                                          &eye_normal.x,
                                          &shaded.uv[i].x,
                                          frame.quadric[v]};
            std::string bytes;
            for (const VertexAttribute& attribute : buffers_.attributes)
                bytes.append(reinterpret_cast<const char*>(parts[attribute.location]),
                             static_cast<std::size_t>(attribute.components) * sizeof(float));
            buffers_.indices.push_back(vertex_of(bytes, known));
        }
    }

    std::uint32_t vertex_of(const std::string& bytes, Known& known) {
        const auto next = static_cast<std::uint32_t>(
            buffers_.vertices.size() / static_cast<std::size_t>(buffers_.floats_a_vertex()));
        const auto [vertex, is_new] = known.emplace(bytes, next);
        if (is_new) {
            const std::size_t end = buffers_.vertices.size();
            buffers_.vertices.resize(end + bytes.size() / sizeof(float));
            std::memcpy(buffers_.vertices.data() + end, bytes.data(), bytes.size());
        }
        return vertex->second;
    }

    const Scene& scene_;
    VertexBuffers buffers_;
    bool fits_quadrics_ = false;
};

}  // namespace

const std::vector<VertexAttribute>& all_vertex_attributes() {
    static const std::vector<VertexAttribute> all = {
        {"position", 0, 3, 0, "the mesh's, object space"},
        {"normal", 1, 3, 0, "the mesh's, object space; 0 in meshes without"},
        {"texture_coordinates", 2, 2, 0, "the mesh's"},
        {"face_normal", 3, 3, 0, "of the triangle, unit, eye space"},
        {"tangent", 4, 3, 0, "of the corner, eye space, as the material's frame makes it"},
        {"handedness", 5, 1, 0, "of the corner's tangents"},
        {"bitangent", 6, 3, 0, "of the corner, eye space, likewise"},
        {"gradient_u", 7, 3, 0, "of u in the triangle's plane, eye space"},
        {"gradient_v", 8, 3, 0, "of v in the triangle's plane, eye space"},
        {"eye_position", 9, 3, 0, "model_view * position"},
        {"clip_position", 10, 4, 0, "projection * eye_position"},
        {"eye_normal", 11, 3, 0, "normal_matrix * normal, or face_normal in meshes without"},
        {"mapped_coordinates", 12, 2, 0, "texture_matrix * texture_coordinates"},
        {"curvature", 13, 2, 0, "quadric of the corner, fitted to the mesh in eye space"}};
    return all;
}

int VertexBuffers::floats_a_vertex() const {
    int floats = 0;
    for (const VertexAttribute& attribute : attributes) floats += attribute.components;
    return floats;
}

VertexBuffers vertex_buffers(const Scene& scene, const std::vector<std::string>& attributes) {
    Builder builder(scene, attributes);
    for (std::size_t object = 0; object < scene.objects.size(); ++object)
        if (scene.objects[object].visible) builder.add(object);
    return builder.take();
}

}  // namespace quadrel
