#include "io/gltf/nodes.hpp"

#include <algorithm>
#include <cmath>

namespace quadrel {
namespace {

std::string node_key(std::size_t index) { return "nodes[" + std::to_string(index) + "]"; }

/// Turns by a quaternion of any length but 0.
glm::dmat4 rotation_matrix(const GltfFile& file, const std::vector<double>& q,
                           const std::string& key) {
    const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(squared > 0) || !std::isfinite(squared))
        file.fail(key + ".rotation", "a quaternion of length 0 or beyond numbers", "a unit one");
    const double s = 2 / squared, x = q[0], y = q[1], z = q[2], w = q[3];
    glm::dmat4 turn(1.0);
    turn[0] = {1 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w), 0};
    turn[1] = {s * (x * y - z * w), 1 - s * (x * x + z * z), s * (y * z + x * w), 0};
    turn[2] = {s * (x * z + y * w), s * (y * z - x * w), 1 - s * (x * x + y * y), 0};
    return turn;
}

glm::dmat4 local_matrix(const GltfFile& file, const tinygltf::Node& node, const std::string& key) {
    glm::dmat4 matrix(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return matrix;
    }
    if (node.translation.size() == 3)
        matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1};
    if (node.rotation.size() == 4) matrix = matrix * rotation_matrix(file, node.rotation, key);
    if (node.scale.size() == 3)
        for (int i = 0; i < 3; ++i) matrix[i] *= node.scale[static_cast<std::size_t>(i)];
    return matrix;
}

/// KHR_node_visibility: what is not visible hides its children, too.
bool is_hidden(const nlohmann::json& node) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end() || !extensions->is_object()) return false;
    const auto visibility = extensions->find("KHR_node_visibility");
    if (visibility == extensions->end() || !visibility->is_object()) return false;
    const auto visible = visibility->find("visible");
    return visible != visibility->end() && *visible == false;
}

class NodeReader {
  public:
    explicit NodeReader(const GltfFile& file)
        : file_(file), nodes_(file.model.nodes), parent_(nodes_.size(), -1) {}

    GltfNodes read() {
        for (std::size_t i = 0; i < nodes_.size(); ++i) check_node(i);
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            for (const int child : nodes_[i].children) adopt(static_cast<int>(i), child);
        GltfNodes out;
        out.global = global_matrices();
        std::vector<int> stack = scene_roots();
        std::reverse(stack.begin(), stack.end());
        while (!stack.empty()) {
            const auto at = static_cast<std::size_t>(stack.back());
            stack.pop_back();
            if (is_hidden(file_.json["nodes"][at])) continue;
            if (nodes_[at].mesh >= 0) out.drawn.push_back(static_cast<int>(at));
            const auto& children = nodes_[at].children;
            stack.insert(stack.end(), children.rbegin(), children.rend());
        }
        return out;
    }

  private:
    void check_index(const std::string& key, int index, std::size_t count) const {
        if (index >= 0 && static_cast<std::size_t>(index) >= count)
            file_.fail(key, std::to_string(index), "below " + std::to_string(count));
    }

    void check_node(std::size_t i) const {
        const tinygltf::Node& node = nodes_[i];
        check_index(node_key(i) + ".mesh", node.mesh, file_.model.meshes.size());
        check_index(node_key(i) + ".skin", node.skin, file_.model.skins.size());
        const nlohmann::json& values = file_.json["nodes"][i];
        for (const char* part : {"translation", "rotation", "scale"})
            if (values.contains("matrix") && values.contains(part))
                file_.fail(node_key(i), std::string("both a matrix and a ") + part,
                           "one way to say it");
    }

    void adopt(int parent, int child) {
        const auto at = static_cast<std::size_t>(child);
        check_index(node_key(static_cast<std::size_t>(parent)) + ".children", child, nodes_.size());
        if (parent_[at] >= 0) file_.fail(node_key(at), "a second way to the node", "a tree");
        parent_[at] = parent;
    }

    std::vector<glm::dmat4> global_matrices() const {
        std::vector<glm::dmat4> global(nodes_.size());
        std::vector<bool> reached(nodes_.size());
        std::vector<std::size_t> stack;
        for (std::size_t i = 0; i < nodes_.size(); ++i)
            if (parent_[i] < 0) stack.push_back(i);
        while (!stack.empty()) {
            const std::size_t at = stack.back();
            stack.pop_back();
            reached[at] = true;
            const glm::dmat4 local = local_matrix(file_, nodes_[at], node_key(at));
            global[at] =
                parent_[at] < 0 ? local : global[static_cast<std::size_t>(parent_[at])] * local;
            for (const int child : nodes_[at].children)
                stack.push_back(static_cast<std::size_t>(child));
        }
        for (std::size_t i = 0; i < reached.size(); ++i)
            if (!reached[i]) file_.fail(node_key(i), "a node below itself", "a tree");
        return global;
    }

    std::vector<int> scene_roots() const {
        const auto& scenes = file_.model.scenes;
        std::vector<int> roots;
        if (scenes.empty()) {
            for (std::size_t i = 0; i < parent_.size(); ++i)
                if (parent_[i] < 0) roots.push_back(static_cast<int>(i));
            return roots;
        }
        const int chosen = std::max(file_.model.defaultScene, 0);
        check_index("scene", chosen, scenes.size());
        roots = scenes[static_cast<std::size_t>(chosen)].nodes;
        const std::string key = "scenes[" + std::to_string(chosen) + "].nodes";
        std::vector<bool> listed(nodes_.size());
        for (const int root : roots) {
            check_index(key, root, nodes_.size());
            const auto at = static_cast<std::size_t>(root);
            if (parent_[at] >= 0) file_.fail(key, "node " + std::to_string(root), "roots of trees");
            if (listed[at]) file_.fail(key, "node " + std::to_string(root) + " twice", "each once");
            listed[at] = true;
        }
        return roots;
    }

    const GltfFile& file_;
    const std::vector<tinygltf::Node>& nodes_;
    std::vector<int> parent_;
};

}  // namespace

GltfNodes lay_out_nodes(const GltfFile& file) { return NodeReader(file).read(); }

}  // namespace quadrel
