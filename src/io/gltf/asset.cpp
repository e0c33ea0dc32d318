#include "io/gltf/asset.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using nlohmann::json;
using Version = std::array<int, 2>;

/// One component of a version: no leading zeros, up to nine digits.
std::optional<int> version_number(std::string_view text) {
    const bool digits =
        std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (text.empty() || text.size() > 9 || !digits) return std::nullopt;
    if (text.size() > 1 && text[0] == '0') return std::nullopt;
    int value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

Version read_version(const std::string& name, const json& asset, const char* key) {
    const std::string path = "asset." + std::string(key);
    const json& value = asset.at(key);
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    const auto dot = std::min(text.find('.'), text.size());
    const auto major = version_number(std::string_view(text).substr(0, dot));
    const auto minor =
        version_number(std::string_view(text).substr(std::min(dot + 1, text.size())));
    if (!value.is_string() || !major || !minor)
        throw InputError(name, path, text, "a version such as 2.0");
    return {*major, *minor};
}

/// Extensions whose effect is in the mesh.
constexpr std::string_view applied[] = {"KHR_mesh_quantization", "KHR_node_visibility",
                                        "KHR_texture_transform"};

/// Extensions of materials, images, lights, animations and data beside the mesh; those that end in
/// _ begin a family.
constexpr std::string_view without_geometry[] = {
    "ADOBE_materials_",
    "AGI_",
    "CESIUM_primitive_outline",
    "EXT_lights_",
    "EXT_materials_",
    "EXT_mesh_features",
    "EXT_mesh_manifold",
    "EXT_mesh_primitive_edge_visibility",
    "EXT_structural_metadata",
    "EXT_texture_",
    "FB_geometry_metadata",
    "GODOT_single_root",
    "KHR_animation_pointer",
    "KHR_audio",
    "KHR_interactivity",
    "KHR_lights_",
    "KHR_materials_",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_techniques_webgl",
    "KHR_texture_",
    "KHR_xmp",
    "KHR_xmp_",
    "MSFT_lod",
    "MSFT_packing_",
    "MSFT_texture_dds",
    "NV_materials_",
};

bool is_applied(std::string_view extension) {
    return std::find(std::begin(applied), std::end(applied), extension) != std::end(applied);
}

bool is_without_geometry(std::string_view extension) {
    return std::any_of(
        std::begin(without_geometry), std::end(without_geometry), [&](std::string_view known) {
            return known.ends_with('_') ? extension.starts_with(known) : extension == known;
        });
}

std::vector<std::string> names_in(const json& root, const char* list) {
    std::vector<std::string> names;
    const auto found = root.find(list);
    if (found == root.end() || !found->is_array()) return names;
    for (const json& name : *found)
        names.push_back(name.is_string() ? name.get<std::string>() : name.dump());
    return names;
}

bool has_some(const json& root, const char* list) {
    const auto found = root.find(list);
    return found != root.end() && !found->empty();
}

}  // namespace

void check_gltf_version(const std::string& name, const json& root) {
    const auto asset = root.find("asset");
    if (asset == root.end() || !asset->is_object() || !asset->contains("version"))
        throw InputError(name, "asset.version", "none", "2.0: that of glTF");
    const Version version = read_version(name, *asset, "version");
    if (asset->contains("minVersion")) {
        const Version least = read_version(name, *asset, "minVersion");
        if (least > version)
            throw InputError(name, "asset.minVersion", (*asset)["minVersion"].get<std::string>(),
                             "at most the version, " + (*asset)["version"].get<std::string>());
        if (least > Version{2, 0})
            throw InputError(name, "asset.minVersion", (*asset)["minVersion"].get<std::string>(),
                             "at most 2.0: what is read here");
    }
    // A newer minor version may add, but change nothing.
    const bool newer_read_as_older = version[0] > 2 && asset->contains("minVersion");
    if (version[0] != 2 && !newer_read_as_older)
        throw InputError(name, "asset.version", (*asset)["version"].get<std::string>(),
                         "2.0: glTF 2 is read here");
}

void check_gltf_extensions(const std::string& name, const json& root) {
    for (const std::string& extension : names_in(root, "extensionsRequired"))
        if (!is_applied(extension) && !is_without_geometry(extension))
            throw InputError(name, "extensionsRequired", "the extension " + extension,
                             "none that geometry needs, beyond those known here");
}

std::vector<std::string> ignored_in_gltf(const json& root) {
    constexpr std::size_t most = 32;  // beyond, the file is not meant to be read
    std::vector<std::string> ignored = names_in(root, "extensionsUsed");
    const auto is_done = [](const std::string& name) { return is_applied(name); };
    ignored.erase(std::remove_if(ignored.begin(), ignored.end(), is_done), ignored.end());
    if (ignored.size() > most) ignored.resize(most);
    for (const char* list : {"animations", "cameras"})
        if (has_some(root, list)) ignored.push_back(list);
    if (root.contains("scenes") && root["scenes"].is_array() && root["scenes"].size() > 1)
        ignored.push_back("other scenes");
    return ignored;
}

}  // namespace quadrel
