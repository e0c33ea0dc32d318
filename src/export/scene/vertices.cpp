#include "export/scene/vertices.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <map>

#include "export/scene/shells.hpp"
#include "render/draw/shell.hpp"
#include "render/draw/vertex_stage.hpp"
#include "scene/billboard.hpp"

namespace quadrel {
namespace {

/// Indices of vertices by their bytes.
using Known = std::map<std::string, std::uint32_t>;

class Builder {
  public:
    Builder(const Scene& scene, const std::vector<std::string>& names)
        : scene_(scene), shells_(scene) {
        int offset = 0;
        for (std::size_t i = 0; i < all_vertex_attributes().size(); ++i) {
            VertexAttribute attribute = all_vertex_attributes()[i];
            if (std::find(names.begin(), names.end(), attribute.name) == names.end()) continue;
            attribute.offset = offset;
            fits_quadrics_ |= std::string_view(attribute.name) == "curvature";
            offset += attribute.components * static_cast<int>(sizeof(float));
            buffers_.attributes.push_back(attribute);
            part_of_.push_back(i);
        }
    }

    void add(std::size_t object) {
        Draw draw{object, static_cast<std::uint32_t>(buffers_.indices.size())};
        Known known;
        if (draws_shell(scene_.materials[scene_.objects[object].material]))
            for (const ShellDrawTriangle& triangle : shells_.of(object))
                add_shell_triangle(triangle, known);
        else
            add_mesh(object, known);
        draw.index_count = static_cast<std::uint32_t>(buffers_.indices.size()) - draw.first_index;
        buffers_.draws.push_back(draw);
    }

    VertexBuffers take() { return std::move(buffers_); }

  private:
    /// Of each attribute the address of its numbers, in the order of all_vertex_attributes.
    using Parts = std::array<const float*, 22>;

    void add_mesh(std::size_t object, Known& known) {
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
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
            add_triangle(mesh, shaded, frames, drawn_corners(t, mirrored), known);
    }

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
            Parts parts;
            parts.fill(nothing);
            const float* const own[] = {&mesh.positions[i].x,
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
            std::copy(std::begin(own), std::end(own), parts.begin());
            add_vertex(parts, known);
        }
    }

    void add_shell_triangle(const ShellDrawTriangle& triangle, Known& known) {
        const PrimitiveFrame& frame = triangle.frame;
        for (std::size_t v = 0; v < 3; ++v) {
            const ShellCorner& corner = triangle.corner[v];
            add_vertex({nothing,
                        nothing,
                        nothing,
                        &triangle.face_normal.x,
                        frame.tangent[v],
                        &frame.tangent_sign[v],
                        frame.bitangent[v],
                        frame.J,
                        frame.J + 3,
                        &corner.eye.x,
                        &corner.clip.x,
                        &corner.normal.x,
                        &corner.uv.x,
                        nothing,
                        corner.corner_weights,
                        &corner.shell_depth,
                        &corner.shell_row,
                        corner.strip_nv,
                        corner.strip_tv,
                        corner.strip_bv,
                        &corner.strip_height,
                        &corner.strip_side},
                       known);
        }
    }

    void add_vertex(const Parts& parts, Known& known) {
        std::string bytes;
        for (std::size_t i = 0; i < part_of_.size(); ++i)
            bytes.append(
                reinterpret_cast<const char*>(parts[part_of_[i]]),
                static_cast<std::size_t>(buffers_.attributes[i].components) * sizeof(float));
        buffers_.indices.push_back(vertex_of(bytes, known));
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

    static constexpr float nothing[4]{};

    const Scene& scene_;
    SceneShells shells_;
    VertexBuffers buffers_;
    std::vector<std::size_t> part_of_;  ///< of each attribute, its place among all
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
        {"curvature", 13, 2, 0, "quadric of the corner, fitted to the mesh in eye space"},
        {"face_weights", 13, 3, 0, "of a shell: of the corners of its face, or of its prism"},
        {"face_depth", 14, 1, 0, "of a shell: depth below its top, 0 to 1"},
        {"face_row", 15, 1, 0, "of a shell: row of its face in the table of shells"},
        {"emitted_nv", 4, 3, 0, "of prisms as listed: their normal, as long as they are high"},
        {"emitted_tv", 5, 3, 0, "of prisms as listed: along u"},
        {"emitted_bv", 6, 3, 0, "of prisms as listed: along v"},
        {"emitted_height", 7, 1, 0, "of prisms as listed: 0 at the base, 1 at the top"},
        {"emitted_side", 8, 1, 0,
         "of prisms as listed: 1 where a side faces the eye, else -1 or 0"}};
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
