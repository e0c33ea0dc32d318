#include "conformance/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "file/data_path.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::conformance {
namespace {

const std::string prefix = "rows/";

std::string texture_override(const std::string& key, const char* file) {
    return fmt::format("textures.{}.file={}", key,
                       find_data_file(std::filesystem::path("textures") / file).string());
}

}  // namespace

const std::vector<Map>& maps() {
    static const std::vector<Map> all{
        {"obstacles", "obstacles_color.exr", "obstacles_height.exr", "obstacles_normal_height.exr"},
        {"bricks", "bricks_color.exr", "bricks_height.exr", "bricks_normal_height.exr"},
        {"dunes", "dunes_color.exr", "dunes_height.exr", "bricks_normal_height.exr"}};
    return all;
}

const Map& find_map(const std::string& name) {
    const auto found =
        std::ranges::find(maps(), name, [](const Map& map) { return std::string(map.name); });
    if (found == maps().end())
        throw UsageError(
            fmt::format("--maps: found \"{}\", expected obstacles, bricks or dunes", name));
    return *found;
}

std::vector<std::string> all_rows() {
    std::vector<std::string> rows;
    for (const std::string& scene : installed_scenes())
        if (scene.starts_with(prefix)) rows.push_back(scene.substr(prefix.size()));
    return rows;
}

Scene scene_of(const Case& what, const std::string& hardware) {
    const Map& map = find_map(what.map);
    const std::string name = prefix + what.row;
    const Scene own = load_scene(name);
    std::vector<std::string> overrides{
        fmt::format("size=[{},{}]", what.size, what.size), "hardware=" + hardware,
        // All of the quad is in view: implementations clip what is not, and clipped triangles have
        // other roundings. A card is as large as the ball around what it stands for.
        "camera.eye=[0,0,6]",
        fmt::format("camera.fov_y={}", own.meshes.front().billboard ? 30 : 24),
        fmt::format("objects[0].transform=[{{\"rotate\":{},\"axis\":[1,0,0]}}]", -what.angle)};
    const auto& textures = own.materials.front().textures;
    const auto height = textures.find("height");
    const bool has_normals = textures.contains("normal");
    if (textures.contains("color")) overrides.push_back(texture_override("color", map.color));
    // Of formats of 8 bits implementations decode and filter each their own way (data/gl).
    for (const char* const slot : {"color", "color_2", "color_3", "color_4"})
        if (textures.contains(slot))
            overrides.push_back(fmt::format("textures.{}.format=half", slot));
    if (height != textures.end())
        overrides.push_back(texture_override(
            "height", height->second.swizzle == "a" ? map.normal_height : map.height));
    if (has_normals) overrides.push_back(texture_override("normal", map.normal_height));
    Scene scene = load_scene(name, overrides);
    // Maps that cases share are loaded, and what is derived from them is, once.
    static const auto cache = std::make_shared<TextureCache>();
    scene.texture_cache = cache;
    return scene;
}

std::string hardware_of(const std::string& renderer) {
    if (renderer.find("llvmpipe") != std::string::npos) return "llvmpipe";
    return renderer.find("SwiftShader") != std::string::npos ? "chromium" : "exact";
}

}  // namespace quadrel::conformance
