#include "cli/info/mesh_info.hpp"

#include <fmt/format.h>

#include "quadrel/scene/mesh_file.hpp"
#include "text/printable.hpp"

namespace quadrel::cli {
namespace {

/// The least and the greatest of each component.
template <class Vector>
Json bounds(const std::vector<Vector>& list) {
    Vector low = list.front(), high = list.front();
    for (const Vector& v : list)
        for (int i = 0; i < Vector::length(); ++i) {
            low[i] = std::min(low[i], v[i]);
            high[i] = std::max(high[i], v[i]);
        }
    Json from = Json::array(), to = Json::array();
    for (int i = 0; i < Vector::length(); ++i) {
        from.push_back(low[i]);
        to.push_back(high[i]);
    }
    return {{"min", from}, {"max", to}};
}

}  // namespace

Json mesh_info(const std::string& file) {
    const MeshFile read = read_mesh_file(file);
    const Mesh& mesh = read.mesh;
    Json info = {{"kind", "mesh"},
                 {"vertices", mesh.positions.size()},
                 {"triangles", mesh.triangles.size()},
                 {"normals", mesh.normals.empty() ? "flat" : "from the file"},
                 {"tangents", !mesh.tangents.empty()},
                 {"uv_sets", read.uv_sets},
                 {"bounds", bounds(mesh.positions)}};
    if (!mesh.uvs.empty()) info["uv_bounds"] = bounds(mesh.uvs);
    if (!read.materials.empty()) {
        info["materials"] = Json::array();
        for (const std::string& name : read.materials) info["materials"].push_back(printable(name));
    }
    Json ignored = Json::array();
    for (const std::string& name : read.ignored) ignored.push_back(printable(name));
    info["ignored"] = ignored;
    return info;
}

}  // namespace quadrel::cli
