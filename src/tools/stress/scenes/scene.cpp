#include "stress/scenes/scene.hpp"

#include <algorithm>
#include <fstream>

#include "quadrel/relief/registry.hpp"
#include "render/plan/shell_check.hpp"

namespace quadrel::stress {
namespace {

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// The maps whose files a document names.
void write_named_maps(const std::filesystem::path& folder, const std::string& document) {
    for (const auto* kinds : {&map_kinds(), &nan_map_kinds()})
        for (const std::string& kind : *kinds)
            for (const auto& [width, height] : map_sizes()) {
                const MapName map{kind, width, height};
                if (document.find('"' + map.file() + '"') != std::string::npos)
                    write_map(folder, map);
            }
}

}  // namespace

void write_scene(const std::filesystem::path& folder, const StressScene& scene) {
    const std::string text = scene.document.dump(2) + "\n";
    write_text(folder / "scene.json", text);
    if (!scene.mesh.empty()) write_text(folder / scene.mesh_file(), scene.mesh);
    write_named_maps(folder, text);
}

std::vector<std::string> stage_ids(const std::string& room, bool judges) {
    std::vector<std::string> ids;
    for (const StageInfo& stage : all_stages()) {
        const std::string id(stage.text.id);
        if (stage.text.room != room || is_of_shells(id)) continue;
        // Of one plane, and not of so much of it: scenes here are of anything.
        if (std::ranges::count(stage.textures, TextureSlot::prewarp) != 0) continue;
        if (judges || id.find("oracle") == std::string::npos) ids.push_back(id);
    }
    return ids;
}

Json texture_of(const MapName& map) {
    Json texture = {{"file", map.file()}, {"format", "float"}};
    if (map.has_nan()) texture["allow_nan"] = true;
    return texture;
}

StressScene plain_scene(const std::string& name, const MapName& map, double degrees,
                        const std::string& trace) {
    StressScene scene;
    scene.name = name;
    scene.has_nan = map.has_nan();
    const MapName colour{"noise", 16, 16};
    scene.document = {{"quadrel", 1},
                      {"size", {16, 16}},
                      {"camera", {{"fov_y", 40}, {"eye", {0, 0, 3}}, {"target", {0, 0, 0}}}},
                      {"materials", Json::object()},
                      {"objects", Json::array()},
                      {"lights", Json::array()}};
    material_of(scene) = {{"color", texture_of(colour)},    {"gloss", texture_of(colour)},
                          {"emissive", texture_of(colour)}, {"normal", texture_of(colour)},
                          {"height", texture_of(map)},      {"layers", texture_of(colour)},
                          {"shade", "shade-thesis"}};
    relief_of(scene) = {{"frame", "frame-gram"},
                        {"trace", trace},
                        {"surface", "h2n-thesis"},
                        {"shadow", "shadow-march-thesis"},
                        {"depth", 0.1}};
    scene.document["objects"].push_back(
        {{"mesh", {{"shape", "quad"}, {"size", 2}}},
         {"material", "stress"},
         {"transform", Json::array({Json{{"rotate", -degrees}, {"axis", {1, 0, 0}}}})}});
    scene.document["lights"].push_back(
        {{"type", "point"}, {"space", "eye"}, {"position", {-2, 3, 1}}});
    return scene;
}

void scale_scene(StressScene& scene, double factor) {
    Json& document = scene.document;
    document["camera"] = {{"fov_y", 40},
                          {"eye", {0, 0, 3 * factor}},
                          {"target", {0, 0, 0}},
                          {"near", 0.1 * factor},
                          {"far", 100 * factor}};
    document["objects"][0]["transform"].push_back(Json::object({{"scale", factor}}));
    document["lights"][0]["position"] = {-2 * factor, 3 * factor, factor};
    relief_of(scene)["depth"] = std::min(relief_of(scene)["depth"].get<double>() * factor, 1e12);
}

void move_scene(StressScene& scene, double distance) {
    Json& document = scene.document;
    document["camera"]["eye"] = {distance, distance, 3};
    document["camera"]["target"] = {distance, distance, 0};
    document["objects"][0]["transform"].push_back(
        Json::object({{"translate", {distance, distance, 0}}}));
}

}  // namespace quadrel::stress
