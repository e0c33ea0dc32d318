#include "io/document/choices.hpp"

#include <algorithm>

#include "io/document/keys.hpp"
#include "io/document/stage_parameters.hpp"
#include "io/document/stages.hpp"
#include "io/document/value.hpp"
#include "quadrel/scene/default_stage.hpp"

namespace quadrel {
namespace {

class Namer {
  public:
    explicit Namer(const SceneDocument& document) : document_(document) {}

    void visit_material(Json& material, const std::string& path) {
        if (!material.is_object()) return;
        const Json* height = member_of(&material, "height");
        const bool layers = member_of(&material, "layers") != nullptr;
        heights_ = height == nullptr ? (layers ? HeightSource::layers : HeightSource::none)
                   : member_of(height, "noise") == nullptr ? HeightSource::map
                                                           : HeightSource::noise;
        visit(material, path, "material");
        if (material.contains("relief"))
            visit(material["relief"], join_key(path, "relief"), "relief");
    }

  private:
    /// The stages that `owner`, a material or its relief, chooses.
    void visit(Json& owner, const std::string& path, const std::string& section) {
        if (!owner.is_object()) return;
        for (const SceneKey& row : scene_keys()) {
            if (row.section != section || row.below_section != "stage") continue;
            const std::string key(row.key);
            const std::string stage = stage_of(owner, key);
            // Parameters of the search may stand in the relief itself.
            if (key == "trace") name_values(stage, owner, path, section);
            if (owner.contains(key)) name_values(stage, owner[key], join_key(path, key), "stage");
        }
    }

    std::string stage_of(const Json& owner, const std::string& key) const {
        std::string room = key;
        std::ranges::replace(room, '_', '-');
        const std::string id = named_stage(&owner, key);
        return id.empty() ? default_stage(room, heights_) : id;
    }

    void name_values(const std::string& stage, Json& holder, const std::string& path,
                     const std::string& section) const {
        if (!holder.is_object()) return;
        for (auto& [key, value] : holder.items()) {
            const ParameterText* parameter = find_parameter(stage, key);
            if (parameter == nullptr || find_scene_key(section, key) != nullptr) continue;
            if (value.is_number())
                write_name(*parameter, value);
            else
                check_name(*parameter, {document_, value, join_key(path, key)});
        }
    }

    static void write_name(const ParameterText& parameter, Json& number) {
        const std::string_view name = name_of_value(parameter, number.get<double>());
        if (!name.empty()) number = std::string(name);
    }

    static void check_name(const ParameterText& parameter, const SceneValue& value) {
        const bool named = value.json().is_string();
        const ParameterValue given = named ? ParameterValue(value.string()) : ParameterValue();
        if (!named || !number_of(parameter, given)) value.reject(expected_of(parameter, given));
    }

    const SceneDocument& document_;
    HeightSource heights_ = HeightSource::none;
};

}  // namespace

void name_choices(SceneDocument& document) {
    Namer namer(document);
    Json& root = document.root;
    if (root.contains("material")) namer.visit_material(root["material"], "material");
    if (root.contains("materials") && root["materials"].is_object())
        for (auto& [name, material] : root["materials"].items())
            namer.visit_material(material, join_key("materials", name));
}

}  // namespace quadrel
