// Small glTF files, made in the tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace quadrel {

inline std::string little_endian(std::uint32_t value) {
    std::string text(4, '\0');
    std::memcpy(text.data(), &value, 4);
    return text;
}

/// A binary file of a JSON chunk and others, which have types of up to four letters.
inline std::string glb_of(const nlohmann::json& json,
                          const std::vector<std::pair<std::string, std::string>>& chunks) {
    std::string body;
    const auto add = [&](std::string type, std::string data, char padding) {
        type.resize(4, '\0');
        while (data.size() % 4) data += padding;
        body += little_endian(static_cast<std::uint32_t>(data.size())) + type + data;
    };
    add("JSON", json.dump(), ' ');
    for (const auto& [type, data] : chunks) add(type, data, '\0');
    return "glTF" + little_endian(2) + little_endian(static_cast<std::uint32_t>(12 + body.size())) +
           body;
}

/// A buffer and the views and accessors into it.
class GltfBuilder {
  public:
    template <class T>
    int add(const std::vector<T>& values, int component_type, const std::string& type,
            std::size_t count) {
        while (bytes.size() % 4) bytes += '\0';
        const std::size_t size = values.size() * sizeof(T);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
        bytes.append(reinterpret_cast<const char*>(values.data()), size);
        json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                     {"componentType", component_type},
                                     {"count", count},
                                     {"type", type}});
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    int floats(const std::vector<float>& values, const std::string& type, std::size_t components) {
        return add(values, 5126, type, values.size() / components);
    }
    int shorts(const std::vector<std::uint16_t>& values) {
        return add(values, 5123, "SCALAR", values.size());
    }

    /// One node with one primitive.
    void set_primitive(const nlohmann::json& primitive,
                       const nlohmann::json& node = nlohmann::json::object()) {
        json["meshes"] =
            nlohmann::json::array({{{"primitives", nlohmann::json::array({primitive})}}});
        nlohmann::json with_mesh = node;
        with_mesh["mesh"] = 0;
        json["nodes"] = nlohmann::json::array({with_mesh});
        json["scenes"] = nlohmann::json::array({{{"nodes", {0}}}});
        json["scene"] = 0;
    }

    /// A .gltf text whose buffer is the file `uri`.
    std::string text(const std::string& uri) const {
        nlohmann::json all = json;
        all["buffers"] = nlohmann::json::array({{{"byteLength", bytes.size()}, {"uri", uri}}});
        return all.dump();
    }

    std::string binary() const {
        nlohmann::json all = json;
        all["buffers"] = nlohmann::json::array({{{"byteLength", bytes.size()}}});
        return glb_of(all, {{"BIN", bytes}});
    }

    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;
};

/// A unit square of two triangles in the plane z = 0 with normals and uvs, uv v downwards.
inline GltfBuilder square_gltf(const nlohmann::json& node = nlohmann::json::object()) {
    GltfBuilder gltf;
    const int positions = gltf.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
    const int normals = gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const int uvs = gltf.floats({0, 1, 1, 1, 1, 0, 0, 0.25f}, "VEC2", 2);
    const int tangents = gltf.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);
    const int indices = gltf.shorts({0, 1, 2, 0, 2, 3});
    gltf.set_primitive({{"attributes",
                         {{"POSITION", positions},
                          {"NORMAL", normals},
                          {"TEXCOORD_0", uvs},
                          {"TANGENT", tangents}}},
                        {"indices", indices}},
                       node);
    return gltf;
}

}  // namespace quadrel
