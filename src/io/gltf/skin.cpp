#include "io/gltf/skin.hpp"

namespace quadrel {
namespace {

/// Of one set, four joints and their weights a vertex.
struct Influences {
    GltfNumbers joints, weights;
};

std::vector<Influences> read_influences(const GltfFile& file, const tinygltf::Primitive& primitive,
                                        std::size_t count, const std::string& key) {
    std::vector<Influences> sets;
    while (true) {
        const std::string n = std::to_string(sets.size());
        const auto joints = primitive.attributes.find("JOINTS_" + n);
        const auto weights = primitive.attributes.find("WEIGHTS_" + n);
        const bool has_joints = joints != primitive.attributes.end();
        if (has_joints != (weights != primitive.attributes.end()))
            file.fail(key, "only one of JOINTS_" + n + " and WEIGHTS_" + n, "both");
        if (!has_joints) break;
        Influences& set = sets.emplace_back();
        set.joints = read_numbers(file, joints->second, 4, GltfStored::joints);
        set.weights = read_numbers(file, weights->second, 4, GltfStored::weights);
        if (set.joints.size() != count || set.weights.size() != count)
            file.fail(key + ".JOINTS_" + n, "another number of joints or weights than of positions",
                      std::to_string(count));
    }
    if (sets.empty()) file.fail(key, "no JOINTS_0 in a mesh with a skin", "joints and weights");
    return sets;
}

}  // namespace

std::vector<glm::dmat4> joint_matrices(const GltfFile& file, int skin,
                                       const std::vector<glm::dmat4>& node_matrices) {
    const tinygltf::Skin& found = file.model.skins.at(static_cast<std::size_t>(skin));
    const std::string key = "skins[" + std::to_string(skin) + "]";
    std::vector<glm::dmat4> inverse_bind(found.joints.size(), glm::dmat4(1.0));
    if (found.inverseBindMatrices >= 0)
        inverse_bind = read_matrices(file, found.inverseBindMatrices);
    if (inverse_bind.size() < found.joints.size())
        file.fail(key + ".inverseBindMatrices", std::to_string(inverse_bind.size()),
                  "one a joint: " + std::to_string(found.joints.size()));
    std::vector<glm::dmat4> matrices;
    for (std::size_t i = 0; i < found.joints.size(); ++i) {
        const auto node = static_cast<std::size_t>(found.joints[i]);
        if (node >= node_matrices.size())
            file.fail(key + ".joints", "node " + std::to_string(node),
                      "below " + std::to_string(node_matrices.size()));
        matrices.push_back(node_matrices[node] * inverse_bind[i]);
    }
    return matrices;
}

std::vector<glm::dmat4> skin_vertices(const GltfFile& file, const tinygltf::Primitive& primitive,
                                      std::size_t vertex_count,
                                      const std::vector<glm::dmat4>& joints,
                                      const std::string& key) {
    const auto sets = read_influences(file, primitive, vertex_count, key);
    std::vector<glm::dmat4> matrices(vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) {
        glm::dmat4 sum(0.0);
        double total = 0;
        for (const Influences& set : sets)
            for (std::size_t i = 0; i < 4; ++i) {
                const auto joint = static_cast<std::size_t>(set.joints[v][i]);
                const double weight = static_cast<double>(set.weights[v][i]);
                if (joint >= joints.size())
                    file.fail(key + ".JOINTS", "joint " + std::to_string(joint),
                              "below " + std::to_string(joints.size()));
                if (weight < 0) file.fail(key + ".WEIGHTS", "a weight below 0", "0 to 1");
                sum += joints[joint] * weight;
                total += weight;
            }
        if (!(total > 0))
            file.fail(key + ".WEIGHTS", "no weight at vertex " + std::to_string(v), "a sum of 1");
        matrices[v] = sum * (1 / total);
    }
    return matrices;
}

}  // namespace quadrel
