#include "quadrel/scene/load.hpp"

#include <algorithm>

#include "io/data_path.hpp"
#include "io/glib_commands.hpp"
#include "io/glib_scene.hpp"
#include "io/hash.hpp"
#include "io/read_file.hpp"
#include "io/scene_objects.hpp"
#include "io/scene_override.hpp"
#include "io/scene_read.hpp"

namespace quadrel {
namespace {

// A name that is too long is none that exists, and no reason to give up here.
bool there_is(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::exists(file, error);
}

// "thesis-quad", or "rows/linear" for one in a folder.
bool is_bare_name(const std::filesystem::path& path) {
    if (path.empty() || path.has_extension() || path.is_absolute()) return false;
    return !path.has_parent_path() || !there_is(path);
}

// A glman scene keeps its extension in its installed name.
std::filesystem::path find_glib(const std::filesystem::path& file) {
    if (file.has_parent_path() || there_is(file)) return file;
    for (const auto& directory : data_directories())
        if (const auto installed = directory / "scenes" / file; there_is(installed))
            return installed;
    return file;
}

std::filesystem::path find_scene(const std::filesystem::path& file_or_name) {
    if (is_glib_file(file_or_name)) return find_glib(file_or_name);
    if (!is_bare_name(file_or_name)) return file_or_name;
    const std::string name = file_or_name.string();
    for (const auto& directory : data_directories()) {
        const auto candidate = directory / "scenes" / (name + ".json");
        if (there_is(candidate)) return candidate;
    }
    throw InputError(name, "", "no installed scene of this name",
                     one_of(name, installed_scenes()) + "; or a path with an extension");
}

SceneDocument open_document(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides) {
    const auto parse = is_glib_file(file) ? parse_glib_text : parse_scene_text;
    SceneDocument document = parse(read_whole_file(file), file);
    check_scene_keys(document);
    for (const std::string& assignment : overrides) apply_override(document, assignment);
    check_scene_keys(document);
    return document;
}

TextureTable read_textures(Fields& root, Hardware hardware) {
    TextureTable textures;
    if (!root.has("textures")) return textures;
    Fields fields(root.get("textures"));
    for (const std::string& name : fields.rest())
        textures[name] = read_texture(fields.value().member(name), hardware);
    return textures;
}

void read_materials(Fields& root, Scene& scene) {
    const TextureTable textures = read_textures(root, scene.hardware);
    if (root.has("material") && root.has("materials"))
        root.value().member("material").fail("both \"material\" and \"materials\"", "one of them");
    if (root.has("material"))
        scene.materials.push_back(
            read_material(root.get("material"), "default", textures, scene.hardware));
    if (root.has("materials")) {
        Fields fields(root.get("materials"));
        for (const std::string& name : fields.rest())
            scene.materials.push_back(
                read_material(fields.value().member(name), name, textures, scene.hardware));
    }
    if (scene.materials.empty()) {
        scene.materials.emplace_back();
        scene.materials.back().name = "default";
    }
}

void read_lights(Fields& root, Scene& scene) {
    if (!root.has("lights")) {
        scene.lights.emplace_back();
        return;
    }
    const Value lights = root.get("lights");
    if (!lights.json().is_array()) lights.reject("an array of lights");
    for (std::size_t i = 0; i < lights.json().size(); ++i)
        scene.lights.push_back(read_light(lights.element(i)));
}

}  // namespace

Scene load_scene(const std::filesystem::path& file_or_name,
                 const std::vector<std::string>& overrides) {
    const SceneDocument document = open_document(find_scene(file_or_name), overrides);
    Fields root(Value(document, document.root, ""));
    Scene scene;
    scene.file = document.file;
    scene.overrides = overrides;
    root.get("quadrel");
    read_settings(root, scene);
    const Json no_camera = Json::object();
    scene.camera = read_camera(
        root.has("camera") ? root.get("camera") : Value(document, no_camera, "camera"), scene);
    read_materials(root, scene);
    read_objects(root, scene);
    read_lights(root, scene);
    if (root.has("environment"))
        scene.environment = read_environment(root.get("environment"), scene.hardware);
    root.finish("a scene");
    scene.canonical = canonical_scene(document);
    scene.hash = sha256_hex(scene.canonical);
    return scene;
}

std::vector<std::string> installed_scenes() {
    std::vector<std::string> names;
    for (const auto& directory : data_directories()) {
        std::error_code error;
        const auto scenes = directory / "scenes";
        for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes, error)) {
            std::filesystem::path name = entry.path().lexically_relative(scenes);
            if (is_glib_file(name)) names.push_back(name.string());
            if (name.extension() == ".json") names.push_back(name.replace_extension().string());
        }
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

}  // namespace quadrel
