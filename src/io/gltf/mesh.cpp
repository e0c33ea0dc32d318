#include "io/gltf/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "io/gltf/asset.hpp"
#include "io/gltf/material/choice.hpp"
#include "io/gltf/material/uvs.hpp"
#include "io/gltf/nodes.hpp"
#include "io/gltf/open.hpp"
#include "io/gltf/primitive.hpp"
#include "io/gltf/skin.hpp"
#include "quadrel/num/functions.hpp"
#include "scene/mesh_corners.hpp"

namespace quadrel {
namespace {

/// A transform as normals and triangles need it.
struct Placement {
    explicit Placement(const glm::dmat4& m) : matrix(m), linear(m) {
        // Cofactors: the inverse transposed times the determinant, whose sign is taken out.
        determinant = dot(linear[0], cross(linear[1], linear[2]));
        const double sign = mirrors() ? -1 : 1;
        normal = glm::dmat3(cross(linear[1], linear[2]) * sign, cross(linear[2], linear[0]) * sign,
                            cross(linear[0], linear[1]) * sign);
        moves_directions = linear != glm::dmat3(1.0);
    }
    bool mirrors() const { return determinant < 0; }

    glm::vec3 point(const glm::dvec3& p) const {
        return glm::vec3(matrix * glm::dvec4(p.x, p.y, p.z, 1));
    }
    glm::vec3 direction(const glm::dmat3& by, const glm::dvec3& d, bool of_unit_length) const {
        if (of_unit_length && !moves_directions) return glm::vec3(d);
        const glm::dvec3 moved = by * d;
        const double size = length(moved);
        return glm::vec3(size > 0 ? moved * (1 / size) : moved);
    }

    glm::dmat4 matrix;
    glm::dmat3 linear, normal;
    double determinant;
    bool moves_directions;
};

/// One for all vertices, or one for each.
class Placements {
  public:
    explicit Placements(const glm::dmat4& matrix) : list_{Placement(matrix)} {}
    explicit Placements(const std::vector<glm::dmat4>& matrices)
        : list_(matrices.begin(), matrices.end()) {}

    const Placement& of(std::size_t vertex) const { return list_[list_.size() == 1 ? 0 : vertex]; }
    // A mirroring node turns its triangles around (glTF 2.0, 3.7.4). A skin ignores its node; its
    // triangles turn where joints mirror most of their corners, as normals do.
    bool mirrors(const std::array<std::uint32_t, 3>& corners) const {
        return of(corners[0]).mirrors() + of(corners[1]).mirrors() + of(corners[2]).mirrors() > 1;
    }

  private:
    std::vector<Placement> list_;
};

class GltfMeshReader {
  public:
    GltfMeshReader(const GltfFile& file, const MeshFileOptions& options)
        : file_(file),
          nodes_(lay_out_nodes(file)),
          flip_v_(options.flip_v.value_or(false)),
          uv_set_(options.uv_set) {
        if (options.material) material_ = gltf_material(file, *options.material);
    }

    MeshFile read() {
        check_vertices();
        for (const int node : nodes_.drawn) add_node(node);
        if (mesh_.triangles.empty() && material_)
            file_.fail("materials",
                       *material_ < 0 ? "no triangles without a material"
                                      : "no triangles of " + gltf_material_name(file_, *material_),
                       "a material that something in the scene has");
        if (mesh_.triangles.empty()) file_.fail("", "no triangles in the scene", "a mesh");
        if (!any_uvs_) mesh_.uvs.clear();
        if (!any_uvs_ && uv_set_ > 0)
            file_.fail("", "no TEXCOORD_" + std::to_string(uv_set_),
                       "a uv_set below " + std::to_string(std::max(uv_sets_, 1)));
        settle_normals(mesh_);
        settle_tangents(mesh_);
        return {std::move(mesh_), uv_sets_, material_names(), ignored()};
    }

  private:
    const tinygltf::Mesh& mesh_of(const tinygltf::Node& node) const {
        return file_.model.meshes[static_cast<std::size_t>(node.mesh)];
    }

    // A small file can refer to one accessor a thousand times.
    void check_vertices() const {
        std::size_t vertices = 0;
        const auto count = [&](int accessor) {
            if (accessor >= 0) vertices += accessor_count(file_, accessor);
        };
        for (const int node : nodes_.drawn)
            for (const auto& primitive :
                 mesh_of(file_.model.nodes[static_cast<std::size_t>(node)]).primitives) {
                for (const auto& [name, accessor] : primitive.attributes)
                    if (name == "POSITION") count(accessor);
                count(primitive.indices);
                for (const auto& target : primitive.targets)
                    for (const auto& [name, accessor] : target) count(accessor);
            }
        if (vertices > max_mesh_vertices)
            file_.fail("", std::to_string(vertices) + " vertices and indices",
                       "at most " + std::to_string(max_mesh_vertices) + " in a mesh");
    }

    void add_node(int index) {
        const auto at = static_cast<std::size_t>(index);
        const tinygltf::Node& node = file_.model.nodes[at];
        const tinygltf::Mesh& mesh = mesh_of(node);
        const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
        std::vector<glm::dmat4> joints;
        if (node.skin >= 0) joints = joint_matrices(file_, node.skin, nodes_.global);
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const tinygltf::Primitive& primitive = mesh.primitives[i];
            const std::string key =
                "meshes[" + std::to_string(node.mesh) + "].primitives[" + std::to_string(i) + "]";
            if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
                ignored_.insert("points and lines");
                continue;
            }
            if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
                file_.fail(key + ".mode", std::to_string(primitive.mode), "0 to 6");
            if (material_ && primitive.material != *material_) {
                // Of the same object: all have coordinates, or none.
                any_uvs_ = any_uvs_ || primitive.attributes.count(uv_name()) > 0;
                continue;
            }
            materials_.insert(primitive.material);
            note_attributes(primitive);
            const GltfPrimitive read = read_primitive(file_, primitive, weights, uv_set_, key);
            const Placements placements =
                node.skin < 0 ? Placements(nodes_.global[at])
                              : Placements(skin_vertices(file_, primitive, read.positions.size(),
                                                         joints, key));
            append(read, placements, material_uvs(file_, primitive.material, uv_set_), key);
        }
    }

    std::string uv_name() const { return "TEXCOORD_" + std::to_string(uv_set_); }

    void note_attributes(const tinygltf::Primitive& primitive) {
        constexpr std::size_t most = 16;
        int sets = 0;
        while (primitive.attributes.count("TEXCOORD_" + std::to_string(sets))) ++sets;
        uv_sets_ = std::max(uv_sets_, sets);
        const std::set<std::string> read = {"POSITION", "NORMAL", "TANGENT", uv_name()};
        for (const auto& [name, accessor] : primitive.attributes) {
            const bool of_skin = name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
            if (!of_skin && !read.count(name) && ignored_.size() < most) ignored_.insert(name);
        }
    }

    void append(const GltfPrimitive& part, const Placements& placements, const MaterialUvs& uvs,
                const std::string& key) {
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        for (std::size_t v = 0; v < part.positions.size(); ++v) {
            const glm::vec3 p = placements.of(v).point(part.positions[v]);
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                file_.fail(key, "a position that transforms make infinite", "finite ones");
            mesh_.positions.push_back(p);
        }
        append_normals(part, placements);
        append_uvs(part, uvs, key);
        append_tangents(part, placements, uvs);
        for (auto triangle : part.triangles) {
            if (placements.mirrors(triangle)) std::swap(triangle[1], triangle[2]);
            for (auto& corner : triangle) corner += base;
            mesh_.triangles.push_back(triangle);
        }
    }

    // Null where the primitive has none: flat ones follow.
    void append_normals(const GltfPrimitive& part, const Placements& placements) {
        for (std::size_t v = 0; v < part.normals.size(); ++v) {
            const Placement& place = placements.of(v);
            mesh_.normals.push_back(place.direction(place.normal, part.normals[v], !part.morphed));
        }
        mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0.0f));
    }

    // A point of texture space where there are none.
    void append_uvs(const GltfPrimitive& part, const MaterialUvs& uvs, const std::string& key) {
        any_uvs_ = any_uvs_ || !part.uvs.empty();
        if (!part.uvs.empty() && uvs.others_differ) ignored_.insert("other texture transforms");
        const UvTransform& transform = uvs.transform;
        for (const glm::dvec2& stored : part.uvs) {
            const glm::vec2 uv(transform == UvTransform{}
                                   ? stored
                                   : transform.linear[0] * stored.x +
                                         transform.linear[1] * stored.y + transform.offset);
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
                file_.fail(key, "texture coordinates that their transform makes infinite",
                           "finite ones");
            mesh_.uvs.emplace_back(uv.x, flip_v_ ? 1 - uv.y : uv.y);
        }
        mesh_.uvs.resize(mesh_.positions.size(), glm::vec2(0.0f));
    }

    // Null where they belong to other coordinates than the mesh gets: MikkTSpace's follow.
    void append_tangents(const GltfPrimitive& part, const Placements& placements,
                         const MaterialUvs& uvs) {
        if (uvs.has_tangents && uvs.transform.keeps_directions())
            for (std::size_t v = 0; v < part.tangents.size(); ++v) {
                const Placement& place = placements.of(v);
                const float sign = place.mirrors() != flip_v_ ? -1.0f : 1.0f;
                mesh_.tangents.emplace_back(
                    place.direction(place.linear, part.tangents[v], !part.morphed),
                    part.handedness[v] * sign);
            }
        mesh_.tangents.resize(mesh_.positions.size(), glm::vec4(0.0f));
    }

    std::string wrong_bounds_text() const {
        constexpr std::size_t most = 4;
        std::string text = "min and max that contradict the elements of";
        std::size_t named = 0;
        for (const int accessor : file_.wrong_bounds) {
            if (named++ == most) return text + " ...";
            text += " accessors[" + std::to_string(accessor) + "]";
        }
        return text;
    }

    std::vector<std::string> material_names() const {
        std::vector<std::string> names;
        for (const int material : materials_)
            if (material >= 0) names.push_back(gltf_material_name(file_, material));
        return names;
    }

    std::vector<std::string> ignored() const {
        std::vector<std::string> names = ignored_in_gltf(file_.json);
        names.insert(names.end(), ignored_.begin(), ignored_.end());
        if (!file_.wrong_bounds.empty()) names.push_back(wrong_bounds_text());
        return names;
    }

    const GltfFile& file_;
    const GltfNodes nodes_;
    bool flip_v_;
    int uv_set_;
    std::optional<int> material_;  ///< the only one whose triangles count
    bool any_uvs_ = false;
    int uv_sets_ = 0;
    std::set<int> materials_;        ///< of the triangles, -1 for none
    std::set<std::string> ignored_;  ///< of primitives that are drawn
    Mesh mesh_;
};

}  // namespace

MeshFile load_gltf(const std::filesystem::path& path, const MeshFileOptions& options) {
    const GltfFile file = open_gltf(path);
    return GltfMeshReader(file, options).read();
}

}  // namespace quadrel
