#include "io/gltf/primitive.hpp"

#include <cmath>

namespace quadrel {
namespace {

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

class PrimitiveReader {
  public:
    PrimitiveReader(const GltfFile& file, const tinygltf::Primitive& primitive,
                    const std::vector<double>& weights, const std::string& key)
        : file_(file), primitive_(primitive), weights_(weights), key_(key) {}

    GltfPrimitive read(int uv_set) {
        check_targets();
        out_.positions = vectors<3>("POSITION", GltfStored::positions);
        if (out_.positions.empty()) file_.fail(key_, "no POSITION", "positions");
        out_.normals = vectors<3>("NORMAL", GltfStored::directions);
        if (!out_.normals.empty()) read_tangents();
        const auto uvs = vectors<2>("TEXCOORD_" + std::to_string(uv_set), GltfStored::positions);
        for (const auto& uv : uvs) out_.uvs.emplace_back(uv.x, uv.y);
        read_triangles();
        return std::move(out_);
    }

  private:
    void check_targets() const {
        if (weights_.size() == primitive_.targets.size() || weights_.empty()) return;
        file_.fail(key_ + ".targets", std::to_string(primitive_.targets.size()),
                   "one per weight: " + std::to_string(weights_.size()));
    }

    // The attribute and the weighted sum of its displacements; z is 0 where there are two.
    template <std::size_t components>
    std::vector<glm::dvec3> vectors(const std::string& name, GltfStored stored) {
        const auto found = primitive_.attributes.find(name);
        if (found == primitive_.attributes.end()) return {};
        std::vector<glm::dvec3> out;
        const GltfNumbers base = read_numbers(file_, found->second, components, stored);
        if (name != "POSITION") check_count(name, base.size(), out_.positions.size());
        for (std::size_t v = 0; v < base.size(); ++v) out.push_back(vector<components>(base[v]));
        for (std::size_t t = 0; t < weights_.size(); ++t) {
            const auto target = primitive_.targets[t].find(name);
            if (weights_[t] == 0 || target == primitive_.targets[t].end()) continue;
            const GltfNumbers moved = read_numbers(file_, target->second, components, stored);
            check_count("targets[" + std::to_string(t) + "]." + name, moved.size(), out.size());
            for (std::size_t v = 0; v < out.size(); ++v)
                out[v] += vector<components>(moved[v]) * weights_[t];
            out_.morphed = true;
        }
        return out;
    }

    template <std::size_t components>
    static glm::dvec3 vector(const float* values) {
        return {values[0], values[1], components == 3 ? values[2] : 0.0f};
    }

    void check_count(const std::string& name, std::size_t count, std::size_t positions) const {
        if (count != positions)
            file_.fail(key_ + "." + name, std::to_string(count) + " elements",
                       "as many as positions: " + std::to_string(positions));
    }

    // Displacements have three components, without the handedness.
    void read_tangents() {
        const auto found = primitive_.attributes.find("TANGENT");
        if (found == primitive_.attributes.end()) return;
        const GltfNumbers base = read_numbers(file_, found->second, 4, GltfStored::directions);
        check_count("TANGENT", base.size(), out_.positions.size());
        for (std::size_t v = 0; v < base.size(); ++v) {
            const float w = base[v][3];
            if (!(std::abs(std::abs(w) - 1) < 1e-2f))
                file_.fail(key_ + ".TANGENT", "w = " + std::to_string(w), "1 or -1");
            out_.handedness.push_back(w < 0 ? -1.0f : 1.0f);
            out_.tangents.push_back(vector<3>(base[v]));
        }
        for (std::size_t t = 0; t < weights_.size(); ++t) {
            const auto target = primitive_.targets[t].find("TANGENT");
            if (weights_[t] == 0 || target == primitive_.targets[t].end()) continue;
            const GltfNumbers moved =
                read_numbers(file_, target->second, 3, GltfStored::directions);
            check_count("targets[" + std::to_string(t) + "].TANGENT", moved.size(),
                        out_.tangents.size());
            for (std::size_t v = 0; v < moved.size(); ++v)
                out_.tangents[v] += vector<3>(moved[v]) * weights_[t];
            out_.morphed = true;
        }
    }

    void read_triangles() {
        const std::size_t vertices = out_.positions.size();
        std::vector<std::uint32_t> indices;
        if (primitive_.indices >= 0) indices = read_indices(file_, primitive_.indices);
        for (const std::uint32_t index : indices)
            if (index >= vertices)
                file_.fail(key_ + ".indices", "vertex " + std::to_string(index),
                           "below " + std::to_string(vertices));
        const std::size_t count = primitive_.indices >= 0 ? indices.size() : vertices;
        const bool triangles = primitive_.mode == TINYGLTF_MODE_TRIANGLES;
        if (count < 3 || (triangles && count % 3 != 0))
            file_.fail(key_, std::to_string(count) + (indices.empty() ? " vertices" : " indices"),
                       triangles ? "three per triangle" : "at least 3");
        out_.triangles = triangles_of(primitive_.mode, count);
        for (auto& triangle : out_.triangles)
            for (auto& corner : triangle)
                if (!indices.empty()) corner = indices[corner];
    }

    const GltfFile& file_;
    const tinygltf::Primitive& primitive_;
    const std::vector<double>& weights_;
    const std::string& key_;
    GltfPrimitive out_;
};

}  // namespace

GltfPrimitive read_primitive(const GltfFile& file, const tinygltf::Primitive& primitive,
                             const std::vector<double>& weights, int uv_set,
                             const std::string& key) {
    return PrimitiveReader(file, primitive, weights, key).read(uv_set);
}

}  // namespace quadrel
