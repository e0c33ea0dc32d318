#include "io/scene/file_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "io/gltf/container.hpp"
#include "io/gltf/material/materials.hpp"
#include "text/printable.hpp"

namespace quadrel {
namespace {

/// A member that is a text; empty where it is none.
std::string text_member(const Json& object, const char* key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return "";
    return object[key].get<std::string>();
}

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

/// Returns the keys that are the defaults' now.
std::set<std::string> add_defaults(const Json& defaults, Json& material) {
    std::set<std::string> added;
    const bool normal_map = defaults.contains("normal") && wants_normal_map(material);
    for (const auto& [key, value] : defaults.items())
        if (!material.contains(key) && (key != "normal" || normal_map)) {
            material[key] = value;
            added.insert(key);
        }
    if (!normal_map) return added;
    Json& relief = material["relief"];
    relief["surface"] = {{"id", "normal-map"}, {"green", "down"}};
    // Without a frame a normal has no directions; glTF's are MikkTSpace's (3.7.2.1).
    if (!relief.contains("frame")) relief["frame"] = "frame-mikkt";
    return added;
}

/// One of a file's materials, and where it has met a scene's: which words of it were taken, and of
/// which the scene had its own. A word may be both, by different materials of the scene.
struct SourceMaterial : GltfMaterial {
    std::vector<std::string> taken, own;

    void note_keys(const std::set<std::string>& added) {
        for (const GltfWord& word : words) {
            auto& list = added.contains(word.key) ? taken : own;
            if (std::ranges::count(list, word.text) == 0) list.push_back(word.text);
        }
    }
};

/// A file as a mesh names it, and the materials of what it draws.
struct Source {
    std::filesystem::path file;
    std::vector<SourceMaterial> materials;
};

/// What is another is a mistake of the scene's.
bool is_choice(const Json& mesh) {
    return !mesh.contains("material") || mesh["material"].is_number_integer() ||
           mesh["material"].is_string();
}

MeshFileOptions options_of(const Json& mesh) {
    MeshFileOptions options;
    if (mesh.contains("uv_set") && mesh["uv_set"].is_number_integer())
        options.uv_set = mesh["uv_set"].get<int>();
    if (!mesh.contains("material")) return options;
    const Json& material = mesh["material"];
    if (material.is_number_integer()) options.material = material.get<int>();
    if (material.is_string()) options.material = material.get<std::string>();
    return options;
}

// ---- What is said of a file ---------------------------------------------------------------------

/// Words of several materials, and whose they are: "normal", "occlusion (why) of brass, glass".
std::string words_text(const std::vector<const SourceMaterial*>& materials,
                       std::vector<std::string> SourceMaterial::*words) {
    std::vector<std::pair<std::string, std::vector<std::string>>> owners;
    for (const SourceMaterial* const material : materials)
        for (const std::string& word : material->*words) {
            const auto found = std::find_if(owners.begin(), owners.end(),
                                            [&](const auto& entry) { return entry.first == word; });
            auto& of = found == owners.end() ? owners.emplace_back(word, std::vector<std::string>())
                                             : *found;
            of.second.push_back(shortened(material->name, 40));
        }
    constexpr std::size_t most_named = 3;
    std::vector<std::string> texts;
    for (const auto& [word, of] : owners)
        texts.push_back(of.size() == materials.size() ? word
                        : of.size() <= most_named
                            ? fmt::format("{} of {}", word, fmt::join(of, " and "))
                            : fmt::format("{} of {}", word, of.size()));
    return fmt::format("{}", fmt::join(texts, ", "));
}

/// Empty where the file has no materials.
std::string line_of(const Source& source) {
    constexpr std::size_t most = 2000;
    std::vector<const SourceMaterial*> materials;
    for (const SourceMaterial& material : source.materials)
        if (material.number >= 0) materials.push_back(&material);
    if (materials.empty()) return "";
    const std::string name = materials.size() == 1 ? materials.front()->name
                                                   : fmt::format("{} materials", materials.size());
    const auto text_of = [&](std::vector<std::string> SourceMaterial::*words) {
        const std::string text = words_text(materials, words);
        return text.empty() ? "nothing" : text;
    };
    const std::string own = words_text(materials, &SourceMaterial::own);
    const std::string text =
        fmt::format("{}: taken: {};{} left: {}", name, text_of(&SourceMaterial::taken),
                    own.empty() ? "" : " the scene's own instead: " + own + ";",
                    text_of(&SourceMaterial::left));
    return printable(source.file.string() + ": " + shortened(text, most));
}

// ---- The document -------------------------------------------------------------------------------

/// The name under which a scene's only material without one is found.
constexpr const char* only_material = "default";

class FileMaterials {
  public:
    explicit FileMaterials(SceneDocument& document)
        : document_(document), root_(document.root), before_(document.root) {}

    std::vector<std::string> take() {
        const Json& objects = before_["objects"];
        for (const Json& object : objects) find_use(object);
        for (std::size_t i = 0; i < objects.size(); ++i)
            if (uses_[i].source != nullptr) take_object(i);
        if (!made_.empty()) name_the_others();
        drop_meshes();
        std::vector<std::string> lines;
        for (const Source* const source : in_order_)
            if (std::string line = line_of(*source); !line.empty())
                lines.push_back(std::move(line));
        return lines;
    }

  private:
    /// An object's material in the scene, and the file that its mesh is of; null where it has none.
    struct Use {
        std::optional<std::string> base;
        const Json* mesh = nullptr;
        Source* source = nullptr;
    };
    /// A file's material by its number; what takes nothing is null.
    using Meeting = std::pair<const Source*, int>;

    void find_use(const Json& object) {
        Use use;
        use.base = material_name(before_, object);
        use.mesh = mesh_of(before_, object);
        const std::string name = use.mesh ? text_member(*use.mesh, "file") : "";
        if (use.base && is_gltf_file(name) && !forbids(*use.mesh) && is_choice(*use.mesh))
            use.source = source_of(name, *use.mesh);
        if (use.base && use.source == nullptr) meetings_[*use.base].insert({nullptr, -1});
        if (use.source != nullptr)
            for (const SourceMaterial& material : use.source->materials)
                meetings_[*use.base].insert(meeting_of(*use.source, material));
        uses_.push_back(use);
    }

    static Meeting meeting_of(const Source& source, const SourceMaterial& material) {
        return material.number < 0 ? Meeting{nullptr, -1} : Meeting{&source, material.number};
    }

    /// Null where the file is missing.
    Source* source_of(const std::string& name, const Json& mesh) {
        const std::filesystem::path file = document_.file.parent_path() / name;
        std::error_code none;
        if (!std::filesystem::is_regular_file(file, none)) return nullptr;
        const Json which = {name, mesh.value("uv_set", Json()), mesh.value("material", Json())};
        const auto [found, is_new] = sources_.try_emplace(which.dump());
        if (is_new) {
            Source& source = found->second;
            source.file = file;
            for (GltfMaterial& material : read_gltf_materials(file, options_of(mesh)))
                source.materials.push_back({std::move(material), {}, {}});
            in_order_.push_back(&found->second);
        }
        return &found->second;
    }

    void take_object(std::size_t index) {
        const Use& use = uses_[index];
        const bool several = use.source->materials.size() > 1;
        bool first = true;
        for (SourceMaterial& material : use.source->materials) {
            Json object = before_["objects"][index];
            if (several) {
                if (!object.contains("name") || object["name"].is_string())
                    object["name"] = name_of(object, index) + ": " + material.name;
                object["mesh"] = *use.mesh;
                object["mesh"]["material"] = material.number;
            }
            const std::string taken = take_material(*use.base, *use.source, material);
            if (taken != *use.base) object["material"] = taken;
            if (first)
                root_["objects"][index] = std::move(object);
            else
                root_["objects"].push_back(std::move(object));
            first = false;
        }
        if (several) split_.insert(text_member(before_["objects"][index], "mesh"));
    }

    static std::string name_of(const Json& object, std::size_t index) {
        const std::string name = text_member(object, "name");
        return name.empty() ? fmt::format("object {}", index) : name;
    }

    /// The scene's material that has the defaults: `base` itself where it meets no other.
    std::string take_material(const std::string& base, const Source& source,
                              SourceMaterial& material) {
        const Meeting meeting = meeting_of(source, material);
        if (meeting.first == nullptr) return base;
        if (meetings_[base].size() == 1) {
            Json& only = material_of(root_, base);
            if (only.is_object() && completed_.insert(base).second)
                material.note_keys(add_defaults(material.keys, only));
            return base;
        }
        const auto [found, is_new] = made_.try_emplace({base, meeting});
        if (is_new) found->second = make_material(base, material);
        return found->second;
    }

    std::string make_material(const std::string& base, SourceMaterial& material) {
        Json with_defaults =
            base.empty() ? before_.value("material", Json::object()) : before_["materials"][base];
        if (with_defaults.is_object())
            material.note_keys(add_defaults(material.keys, with_defaults));
        std::string name = label(base) + ": " + shortened(material.name, 80);
        while (root_.contains("materials") && root_["materials"].contains(name))
            name += fmt::format(" ({})", material.number);
        root_["materials"][name] = std::move(with_defaults);
        return name;
    }

    static std::string label(const std::string& base) {
        return base.empty() ? only_material : base;
    }

    /// Who named none meant the only one, which is one of several now.
    void name_the_others() {
        for (Json& object : root_["objects"])
            if (object.is_object() && !object.contains("material"))
                if (const auto base = material_name(before_, object)) {
                    material_of(root_, *base);
                    object["material"] = label(*base);
                }
    }

    /// Named meshes of which all triangles are in others now.
    void drop_meshes() {
        for (const Json& object : root_["objects"]) split_.erase(text_member(object, "mesh"));
        for (const std::string& name : split_)
            if (!name.empty()) root_["meshes"].erase(name);
    }

    SceneDocument& document_;
    Json& root_;
    Json before_;
    std::map<std::string, Source> sources_;
    std::vector<const Source*> in_order_;
    std::vector<Use> uses_;
    std::map<std::string, std::set<Meeting>> meetings_;  ///< of each of the scene's materials
    std::map<std::pair<std::string, Meeting>, std::string> made_;
    std::set<std::string> completed_;  ///< the scene's materials that have their defaults
    std::set<std::string> split_;      ///< named meshes of objects that have become several
};

}  // namespace

std::vector<std::string> take_file_materials(SceneDocument& document) {
    const Json& root = document.root;
    if (!root.contains("objects") || !root["objects"].is_array()) return {};
    return FileMaterials(document).take();
}

}  // namespace quadrel
