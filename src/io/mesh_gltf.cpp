#include "io/mesh_gltf.hpp"

#include <algorithm>
#include <glm/mat4x4.hpp>

#include "io/gltf_open.hpp"
#include "quadrel/num/functions.hpp"
#include "quadrel/scene/mesh_file.hpp"

namespace quadrel {
namespace {

glm::dmat4 node_matrix(const tinygltf::Node& node) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    glm::dmat4 turn(1.0);
    if (node.rotation.size() == 4) {
        const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2],
                     w = node.rotation[3];
        turn[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0};
        turn[1] = {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0};
        turn[2] = {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0};
    }
    if (node.translation.size() == 3)
        matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
    matrix = matrix * turn;
    if (node.scale.size() == 3)
        for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[static_cast<std::size_t>(i)];
    return matrix;
}

/// A node's transform as normals and triangles need it.
struct Placement {
    explicit Placement(const glm::dmat4& m) : matrix(m), linear(m) {
        // Cofactors: the inverse transposed times the determinant, whose sign is taken out.
        determinant = dot(linear[0], cross(linear[1], linear[2]));
        const double sign = mirrors() ? -1 : 1;
        normal = glm::dmat3(cross(linear[1], linear[2]) * sign, cross(linear[2], linear[0]) * sign,
                            cross(linear[0], linear[1]) * sign);
        moves_normals = linear != glm::dmat3(1.0);
    }
    bool mirrors() const { return determinant < 0; }

    glm::vec3 point(const std::array<float, 4>& p) const {
        return glm::vec3(matrix * glm::dvec4(p[0], p[1], p[2], 1));
    }
    glm::vec3 direction(const glm::dmat3& by, const std::array<float, 4>& d) const {
        const glm::dvec3 given(d[0], d[1], d[2]);
        if (!moves_normals) return glm::vec3(given);
        const glm::dvec3 moved = by * given;
        const double size = length(moved);
        return glm::vec3(size > 0 ? moved * (1 / size) : moved);
    }

    glm::dmat4 matrix;
    glm::dmat3 linear, normal;
    double determinant;
    bool moves_normals;
};

std::vector<std::array<std::uint32_t, 3>> triangles_of(int mode, std::size_t count) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto n = static_cast<std::uint32_t>(count);
    if (mode == TINYGLTF_MODE_TRIANGLES)
        for (std::uint32_t i = 0; i + 2 < n; i += 3) triangles.push_back({i, i + 1, i + 2});
    for (std::uint32_t i = 0; i + 2 < n; ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            triangles.push_back({i, i + 1 + i % 2, i + 2 - i % 2});
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) triangles.push_back({i + 1, i + 2, 0});
    }
    return triangles;
}

/// Levels of nodes: each is a call within a call.
constexpr int most_levels = 1000;

class GltfMeshReader {
  public:
    GltfMeshReader(const GltfFile& file, bool flip_v) : file_(file), flip_v_(flip_v) {}

    Mesh read() {
        for (int root : root_nodes()) place_node(root, glm::dmat4(1.0), 1);
        check_vertices();
        for (const Placed& placed : placed_) add_mesh(placed.mesh, placed.matrix);
        if (mesh_.triangles.empty()) file_.fail("", "no triangles", "a mesh");
        if (lacks_normals_) mesh_.normals.clear();
        if (lacks_uvs_) mesh_.uvs.clear();
        if (lacks_tangents_) mesh_.tangents.clear();
        return std::move(mesh_);
    }

  private:
    // Without scenes: every node that is nobody's child.
    std::vector<int> root_nodes() const {
        const auto& model = file_.model;
        if (!model.scenes.empty()) {
            const int chosen = std::max(model.defaultScene, 0);
            if (static_cast<std::size_t>(chosen) >= model.scenes.size())
                file_.fail("scene", std::to_string(chosen),
                           "below " + std::to_string(model.scenes.size()));
            return model.scenes[static_cast<std::size_t>(chosen)].nodes;
        }
        std::vector<bool> is_child(model.nodes.size());
        for (const auto& node : model.nodes)
            for (int child : node.children)
                if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
                    is_child[static_cast<std::size_t>(child)] = true;
        std::vector<int> roots;
        for (std::size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) roots.push_back(static_cast<int>(i));
        return roots;
    }

    void place_node(int index, const glm::dmat4& parent, int level) {
        const auto& nodes = file_.model.nodes;
        const std::string key = "nodes[" + std::to_string(index) + "]";
        if (index < 0 || static_cast<std::size_t>(index) >= nodes.size())
            file_.fail(key, "a reference to it", "one of the " + std::to_string(nodes.size()));
        visited_.resize(nodes.size());
        const auto at = static_cast<std::size_t>(index);
        if (visited_[at]) file_.fail(key, "a second way to the node", "a tree");
        visited_[at] = true;
        if (level > most_levels)
            file_.fail(key, "a node below " + std::to_string(level - 1) + " others",
                       "at most " + std::to_string(most_levels));
        const tinygltf::Node& node = nodes[at];
        const glm::dmat4 matrix = parent * node_matrix(node);
        if (node.mesh >= 0) {
            if (static_cast<std::size_t>(node.mesh) >= file_.model.meshes.size())
                file_.fail(key + ".mesh", std::to_string(node.mesh),
                           "below " + std::to_string(file_.model.meshes.size()));
            placed_.push_back({node.mesh, matrix});
        }
        for (int child : node.children) place_node(child, matrix, level + 1);
    }

    const std::vector<tinygltf::Primitive>& primitives_of(int mesh) const {
        return file_.model.meshes[static_cast<std::size_t>(mesh)].primitives;
    }

    // A small file can refer to one accessor a thousand times.
    void check_vertices() const {
        std::size_t vertices = 0;
        for (const Placed& placed : placed_)
            for (const auto& primitive : primitives_of(placed.mesh))
                for (int accessor : {position_accessor(primitive), primitive.indices})
                    if (accessor >= 0) vertices += accessor_count(file_, accessor);
        if (vertices > max_mesh_vertices)
            file_.fail("", std::to_string(vertices) + " vertices and indices",
                       "at most " + std::to_string(max_mesh_vertices) + " in a mesh");
    }

    static int position_accessor(const tinygltf::Primitive& primitive) {
        const auto found = primitive.attributes.find("POSITION");
        return found == primitive.attributes.end() ? -1 : found->second;
    }

    void add_mesh(int index, const glm::dmat4& matrix) {
        const auto& primitives = primitives_of(index);
        for (std::size_t i = 0; i < primitives.size(); ++i)
            add_primitive(
                primitives[i], Placement(matrix),
                "meshes[" + std::to_string(index) + "].primitives[" + std::to_string(i) + "]");
    }

    void add_primitive(const tinygltf::Primitive& primitive, const Placement& placement,
                       const std::string& key) {
        if (primitive.mode < TINYGLTF_MODE_TRIANGLES) return;  // points and lines
        const auto positions = attribute(primitive, "POSITION", 3, 0, key);
        if (positions.empty()) file_.fail(key, "no POSITION", "positions");
        const std::size_t base = mesh_.positions.size(), count = positions.size();
        for (const auto& p : positions) mesh_.positions.push_back(placement.point(p));
        add_normals(attribute(primitive, "NORMAL", 3, count, key), placement, base + count);
        add_uvs(attribute(primitive, "TEXCOORD_0", 2, count, key), base + count);
        add_tangents(attribute(primitive, "TANGENT", 4, count, key), placement, base + count);
        add_triangles(primitive, placement, base, count, key);
    }

    std::vector<std::array<float, 4>> attribute(const tinygltf::Primitive& primitive,
                                                const char* name, int components, std::size_t count,
                                                const std::string& key) const {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) return {};
        auto values = read_attribute(file_, found->second, components);
        if (count > 0 && values.size() != count)
            file_.fail(key + "." + name, std::to_string(values.size()) + " elements",
                       "as many as positions: " + std::to_string(count));
        return values;
    }

    void add_normals(const std::vector<std::array<float, 4>>& values, const Placement& placement,
                     std::size_t size) {
        lacks_normals_ = lacks_normals_ || values.empty();
        for (const auto& n : values)
            mesh_.normals.push_back(placement.direction(placement.normal, n));
        mesh_.normals.resize(size);
    }

    void add_uvs(const std::vector<std::array<float, 4>>& values, std::size_t size) {
        lacks_uvs_ = lacks_uvs_ || values.empty();
        for (const auto& uv : values) mesh_.uvs.emplace_back(uv[0], flip_v_ ? 1 - uv[1] : uv[1]);
        mesh_.uvs.resize(size);
    }

    void add_tangents(const std::vector<std::array<float, 4>>& values, const Placement& placement,
                      std::size_t size) {
        lacks_tangents_ = lacks_tangents_ || values.empty();
        const float sign = placement.mirrors() ? -1.0f : 1.0f;
        for (const auto& t : values)
            mesh_.tangents.emplace_back(placement.direction(placement.linear, t), t[3] * sign);
        mesh_.tangents.resize(size);
    }

    void add_triangles(const tinygltf::Primitive& primitive, const Placement& placement,
                       std::size_t base, std::size_t count, const std::string& key) {
        std::vector<std::uint32_t> indices;
        if (primitive.indices >= 0) indices = read_indices(file_, primitive.indices);
        for (std::uint32_t index : indices)
            if (index >= count)
                file_.fail(key + ".indices", "vertex " + std::to_string(index),
                           "below " + std::to_string(count));
        const bool indexed = !indices.empty();
        for (auto triangle : triangles_of(primitive.mode, indexed ? indices.size() : count)) {
            for (auto& corner : triangle)
                corner = static_cast<std::uint32_t>(base) + (indexed ? indices[corner] : corner);
            // A mirroring node turns its triangles around (glTF 2.0, 3.7.4).
            if (placement.mirrors()) std::swap(triangle[1], triangle[2]);
            mesh_.triangles.push_back(triangle);
        }
    }

    struct Placed {
        int mesh;
        glm::dmat4 matrix;
    };

    const GltfFile& file_;
    bool flip_v_;
    std::vector<Placed> placed_;
    bool lacks_normals_ = false, lacks_uvs_ = false, lacks_tangents_ = false;
    std::vector<bool> visited_;
    Mesh mesh_;
};

}  // namespace

Mesh load_gltf(const std::filesystem::path& path, bool flip_v) {
    const GltfFile file = open_gltf(path);
    return GltfMeshReader(file, flip_v).read();
}

}  // namespace quadrel
