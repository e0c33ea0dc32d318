#include "quadrel/scene/load.hpp"

#include "file/file_kind.hpp"
#include "file/read_file.hpp"
#include "io/document/choices.hpp"
#include "io/document/override.hpp"
#include "io/document/replaced.hpp"
#include "io/glib/commands.hpp"
#include "io/glib/scene.hpp"
#include "io/scene/file_materials.hpp"
#include "io/scene/find_scene.hpp"
#include "io/scene/objects.hpp"
#include "io/scene/read.hpp"
#include "quadrel/scene/mesh_file.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

void check_materials(const SceneDocument& document) {
    if (document.root.contains("material") && document.root.contains("materials"))
        SceneValue(document, document.root, "")
            .member("material")
            .fail("both \"material\" and \"materials\"", "one of them");
}

SceneDocument open_document(const std::filesystem::path& file,
                            const std::vector<std::string>& overrides,
                            std::vector<std::string>& notes) {
    const auto parse = is_glib_file(file) ? parse_glib_text : parse_scene_text;
    const std::string text = read_whole_file(file);
    const char* const kind = is_mesh_file(file) ? "a mesh" : kind_by_first_bytes(text);
    if (kind != nullptr) throw InputError(file.string(), "", kind, "a scene");
    SceneDocument document = parse(text, file);
    check_scene_keys(document);
    const Json before = document.root;
    for (const std::string& assignment : overrides) apply_override(document, assignment);
    notes = drop_replaced_parameters(before, document);
    check_scene_keys(document);
    check_materials(document);
    for (std::string& line : take_file_materials(document)) notes.push_back(std::move(line));
    name_choices(document);
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

void read_materials(Fields& root, const TextureTable& textures, Scene& scene) {
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
    const SceneValue lights = root.get("lights");
    if (!lights.json().is_array()) lights.reject("an array of lights");
    for (std::size_t i = 0; i < lights.json().size(); ++i)
        scene.lights.push_back(read_light(lights.element(i)));
}

}  // namespace

Scene load_scene(const std::filesystem::path& file_or_name,
                 const std::vector<std::string>& overrides) {
    Scene scene;
    const SceneDocument document = open_document(find_scene(file_or_name), overrides, scene.notes);
    Fields root(SceneValue(document, document.root, ""));
    scene.file = document.file;
    scene.overrides = overrides;
    root.get("quadrel");
    read_settings(root, scene);
    const Json no_camera = Json::object();
    scene.camera = read_camera(
        root.has("camera") ? root.get("camera") : SceneValue(document, no_camera, "camera"), scene);
    const TextureTable textures = read_textures(root, scene.hardware);
    read_materials(root, textures, scene);
    read_objects(root, textures, scene);
    read_lights(root, scene);
    if (root.has("environment"))
        scene.environment = read_environment(root.get("environment"), scene.hardware);
    root.finish("a scene");
    scene.canonical = canonical_scene(document, scene.texture_cache->files());
    scene.hash = sha256_hex(scene.canonical);
    return scene;
}

}  // namespace quadrel
