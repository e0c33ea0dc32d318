#include "io/scene/file_materials.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "io/gltf/materials.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

/// A member that is a text; empty where it is none.
std::string text_member(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return "";
    return object[key].get<std::string>();
}

bool is_gltf(const std::string& file) { return file.ends_with(".gltf") || file.ends_with(".glb"); }

/// The object's mesh, or the mesh that it names.
const Json* mesh_of(const Json& root, const Json& object) {
    if (!object.is_object() || !object.contains("mesh")) return nullptr;
    const Json& mesh = object["mesh"];
    if (mesh.is_object()) return &mesh;
    const std::string name = text_member(object, "mesh");
    const bool named =
        root.contains("meshes") && root["meshes"].is_object() && root["meshes"].contains(name);
    return named && root["meshes"][name].is_object() ? &root["meshes"][name] : nullptr;
}

bool forbids(const Json& mesh) {
    return mesh.contains("materials") && mesh["materials"] == Json(false);
}

/// The name of the object's material, empty for the only one of a scene without names; nothing
/// where there is a mistake.
std::optional<std::string> material_name(const Json& root, const Json& object) {
    if (!root.contains("materials")) return "";
    const Json& all = root["materials"];
    if (!all.is_object() || all.empty()) return std::nullopt;
    const std::string name = !object.contains("material") && all.size() == 1
                                 ? all.begin().key()
                                 : text_member(object, "material");
    if (!all.contains(name)) return std::nullopt;
    return name;
}

Json& material_of(Json& root, const std::string& name) {
    if (!name.empty()) return root["materials"][name];
    Json& material = root["material"];
    if (material.is_null()) material = Json::object();
    return material;
}

/// Heights, layers and a surface of its own say what the normals are.
bool wants_normal_map(const Json& material) {
    for (const char* const key : {"height", "layers", "normal"})
        if (material.contains(key)) return false;
    if (!material.contains("relief")) return true;
    const Json& relief = material["relief"];
    return relief.is_object() && !relief.contains("surface") && !relief.contains("preset");
}

void add_defaults(const Json& defaults, Json& material) {
    const bool normal_map = defaults.contains("normal") && wants_normal_map(material);
    for (const auto& [key, value] : defaults.items())
        if (!material.contains(key) && (key != "normal" || normal_map)) material[key] = value;
    if (normal_map) material["relief"]["surface"] = {{"id", "normal-map"}, {"green", "down"}};
}

std::string line_of(const std::filesystem::path& file, const GltfMaterial& material) {
    return file_note(
        file.string(),
        fmt::format(
            "{}: taken: {}; left: {}", material.name,
            material.taken.empty() ? "nothing" : fmt::format("{}", fmt::join(material.taken, ", ")),
            material.left.empty() ? "nothing" : fmt::format("{}", fmt::join(material.left, ", "))));
}

}  // namespace

std::vector<std::string> take_file_materials(SceneDocument& document) {
    std::vector<std::string> lines;
    Json& root = document.root;
    if (!root.contains("objects") || !root["objects"].is_array()) return lines;
    const Json objects = root["objects"];  // the root grows where it has no material
    std::set<std::string> served;
    for (const Json& object : objects) {
        const Json* const mesh = mesh_of(root, object);
        if (mesh == nullptr || forbids(*mesh) || !is_gltf(text_member(*mesh, "file"))) continue;
        const std::optional<std::string> name = material_name(root, object);
        if (!name || !served.insert(*name).second) continue;
        const std::filesystem::path file = document.file.parent_path() / text_member(*mesh, "file");
        std::error_code none;
        if (!std::filesystem::is_regular_file(file, none)) continue;
        const bool counts = mesh->contains("uv_set") && (*mesh)["uv_set"].is_number_integer();
        const GltfMaterial found =
            read_gltf_material(file, counts ? (*mesh)["uv_set"].get<int>() : 0);
        Json& material = material_of(root, *name);
        if (found.name.empty() || !material.is_object()) continue;
        add_defaults(found.keys, material);
        lines.push_back(line_of(file, found));
    }
    return lines;
}

}  // namespace quadrel
