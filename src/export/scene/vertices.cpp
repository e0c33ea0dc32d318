#include "export/scene/vertices.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <map>

#include "export/scene/whole_triangle.hpp"
#include "render/draw/primitive_vertices.hpp"
#include "render/draw/shell.hpp"
#include "render/draw/vertex_stage.hpp"
#include "scene/billboard.hpp"

namespace quadrel {
namespace {

/// Indices of vertices by their bytes.
using Known = std::map<std::string, std::uint32_t>;

/// An attribute's place among all of them; -1 for what vertex programs make.
int number_of(const VertexAttribute& attribute) {
    const auto& all = all_vertex_attributes();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].name == attribute.name) return static_cast<int>(i);
    return -1;
}

/// An object as its triangles are drawn, flat ones left out.
struct DrawnObject {
    const Mesh& mesh;
    const glm::mat4& model_view;
    const ShadedVertices& shaded;
    std::vector<DrawnCorners> triangles;
};

/// Corners of an object's triangles as vertex programs have them.
class ProgramVertices {
  public:
    explicit ProgramVertices(const DrawnObject& object)
        : rows_(object.mesh, object.model_view, object.shaded.uv) {
        for (const DrawnCorners& drawn : object.triangles) {
            const PrimitiveVertices row = rows_.of(whole_triangle(), drawn);
            for (int v = 0; v < 3; ++v) {
                const auto add = [](std::vector<float>& to, const float* from, int n) {
                    to.insert(to.end(), from, from + n);
                };
                add(list_.position, row.position[v], 3);
                add(list_.normal, row.normal[v], 3);
                add(list_.tangent, row.tangent[v], 3);
                add(list_.binormal, row.binormal[v], 3);
                add(list_.uv, row.uv[v], 2);
                ++list_.count;
            }
        }
    }
    const VertexList& list() const { return list_; }

  private:
    VertexRows rows_;
    VertexList list_;
};

class Builder {
  public:
    Builder(const Scene& scene, const SceneShells& shells,
            const std::vector<VertexAttribute>& attributes, const VertexProgramRun& run)
        : scene_(scene), shells_(shells), run_(run) {
        int offset = 0;
        for (VertexAttribute attribute : attributes) {
            const int number = number_of(attribute);
            attribute.offset = offset;
            offset += attribute.components * static_cast<int>(sizeof(float));
            fits_quadrics_ |= attribute.name == "curvature";
            has_programs_ |= number < 0;
            has_axes_ |=
                number < 0 || attribute.name == "unit_tangent" || attribute.name == "unit_binormal";
            numbers_.push_back(number);
            buffers_.attributes.push_back(attribute);
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
    using Parts = std::array<const float*, 24>;

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
        DrawnObject drawn{mesh, model_view, shaded, {}};
        const bool mirrored = is_mirrored(model_view);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const DrawnCorners corners = drawn_corners(t, mirrored);
            const auto index = indices_of(mesh, corners);
            if (!is_flat(shaded.eye[index[0]], shaded.eye[index[1]], shaded.eye[index[2]]))
                drawn.triangles.push_back(corners);
        }
        VertexList list;
        if (has_axes_) list = ProgramVertices(drawn).list();
        NamedFloats made;
        if (has_programs_) made = run_(object, list);
        for (std::size_t t = 0; t < drawn.triangles.size(); ++t)
            add_triangle(drawn, frames, t, list, made, known);
    }

    void add_triangle(const DrawnObject& drawn, const PrimitiveFrames& frames, std::size_t triangle,
                      const VertexList& list, const NamedFloats& made, Known& known) {
        const Mesh& mesh = drawn.mesh;
        const DrawnCorners& corners = drawn.triangles[triangle];
        const auto index = indices_of(mesh, corners);
        const auto& eye = drawn.shaded.eye;
        const glm::vec3 face = face_normal(eye[index[0]], eye[index[1]], eye[index[2]]);
        const PrimitiveFrame frame = frames.of(whole_triangle(), corners);
        for (int v = 0; v < 3; ++v) {
            const std::size_t corner = 3 * triangle + static_cast<std::size_t>(v);
            const std::uint32_t i = index[static_cast<std::size_t>(v)];
            const glm::vec3 normal = normal_of_corner(mesh, corners.triangle,
                                                      corners.corner[static_cast<std::size_t>(v)]);
            const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[i];
            const glm::vec3 eye_normal = mesh.normals.empty() ? face : drawn.shaded.normal[i];
            Parts parts{};
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
                                        &drawn.shaded.clip[i].x,
                                        &eye_normal.x,
                                        &drawn.shaded.uv[i].x,
                                        frame.quadric[v],
                                        has_axes_ ? &list.tangent[3 * corner] : nullptr,
                                        has_axes_ ? &list.binormal[3 * corner] : nullptr};
            std::copy(std::begin(own), std::end(own), parts.begin());
            add_vertex(parts, made, corner, known);
        }
    }

    void add_shell_triangle(const ShellDrawTriangle& triangle, Known& known) {
        const PrimitiveFrame& frame = triangle.frame;
        for (std::size_t v = 0; v < 3; ++v) {
            const ShellCorner& corner = triangle.corner[v];
            add_vertex({nullptr,
                        nullptr,
                        nullptr,
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
                        nullptr,
                        nullptr,
                        nullptr,
                        corner.corner_weights,
                        &corner.shell_depth,
                        &corner.shell_row,
                        corner.strip_nv,
                        corner.strip_tv,
                        corner.strip_bv,
                        &corner.strip_height,
                        &corner.strip_side},
                       {}, 0, known);
        }
    }

    /// Zeros for what is not there.
    void add_vertex(const Parts& parts, const NamedFloats& made, std::size_t corner, Known& known) {
        std::string bytes;
        for (std::size_t a = 0; a < numbers_.size(); ++a) {
            const VertexAttribute& attribute = buffers_.attributes[a];
            const auto floats = static_cast<std::size_t>(attribute.components);
            const float* const from = numbers_[a] >= 0
                                          ? parts[static_cast<std::size_t>(numbers_[a])]
                                          : made_at(made, attribute, corner);
            if (from != nullptr)
                bytes.append(reinterpret_cast<const char*>(from), floats * sizeof(float));
            else
                bytes.append(floats * sizeof(float), '\0');
        }
        buffers_.indices.push_back(vertex_of(bytes, known));
    }

    /// What the object's vertex programs make for a corner; null where they make none of it.
    static const float* made_at(const NamedFloats& made, const VertexAttribute& attribute,
                                std::size_t corner) {
        const auto found = made.find(attribute.name.substr(std::string_view("shaded_").size()));
        if (found == made.end()) return nullptr;
        return found->second.data() + corner * static_cast<std::size_t>(attribute.components);
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
    const SceneShells& shells_;
    const VertexProgramRun& run_;
    VertexBuffers buffers_;
    std::vector<int> numbers_;  ///< of the attributes
    bool fits_quadrics_ = false, has_programs_ = false, has_axes_ = false;
};

}  // namespace

const std::vector<VertexAttribute>& all_vertex_attributes() {
    static const std::vector<VertexAttribute> all = {
        {"position", 0, 3, 0, "the mesh's, object space"},
        {"normal", 1, 3, 0, "the mesh's, object space; the face's, unit, in meshes without"},
        {"texture_coordinates", 2, 2, 0, "the mesh's"},
        {"face_normal", 3, 3, 0, "of the triangle, unit, eye space"},
        {"tangent", 4, 3, 0, "of the corner, eye space, as the material's frame makes it"},
        {"handedness", 5, 1, 0, "of the corner's tangents"},
        {"bitangent", 6, 3, 0, "of the corner, eye space, likewise"},
        {"gradient_u", 7, 3, 0, "of u in the triangle's plane, eye space"},
        {"gradient_v", 8, 3, 0, "of v in the triangle's plane, eye space"},
        {"eye_position", 9, 3, 0, "eye space: model_view * position, or a shell's corner"},
        {"clip_position", 10, 4, 0, "clip space: projection * eye_position"},
        {"eye_normal", 11, 3, 0,
         "eye space: normal_matrix * normal, or face_normal in meshes without"},
        {"mapped_coordinates", 12, 2, 0, "texture_matrix * texture_coordinates"},
        {"curvature", 13, 2, 0, "quadric of the corner, fitted to the mesh in eye space"},
        {"unit_tangent", 14, 3, 0, "of the corner, along growing u, unit, object space"},
        {"unit_binormal", 15, 3, 0, "of the corner, along growing v, unit, object space"},
        {"face_weights", 16, 3, 0, "of a shell: of the corners of its face, or of its prism"},
        {"face_depth", 17, 1, 0, "of a shell: depth below its top, 0 to 1"},
        {"face_row", 18, 1, 0, "of a shell: row of its face in the table of shells"},
        {"emitted_nv", 19, 3, 0, "of prisms as listed: their normal, as long as they are high"},
        {"emitted_tv", 20, 3, 0, "of prisms as listed: along u"},
        {"emitted_bv", 21, 3, 0, "of prisms as listed: along v"},
        {"emitted_height", 22, 1, 0, "of prisms as listed: 0 at the base, 1 at the top"},
        {"emitted_side", 23, 1, 0,
         "of prisms as listed: 1 on sides that face the eye, -1 on others, 0 on the base and "
         "edge-on"}};
    return all;
}

int VertexBuffers::floats_a_vertex() const {
    int floats = 0;
    for (const VertexAttribute& attribute : attributes) floats += attribute.components;
    return floats;
}

VertexBuffers vertex_buffers(const Scene& scene, const SceneShells& shells,
                             const std::vector<VertexAttribute>& attributes,
                             const VertexProgramRun& run) {
    Builder builder(scene, shells, attributes, run);
    for (std::size_t object = 0; object < scene.objects.size(); ++object)
        if (scene.objects[object].visible) builder.add(object);
    return builder.take();
}

}  // namespace quadrel
