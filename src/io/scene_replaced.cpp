#include "io/scene_replaced.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/scene_keys.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/presets.hpp"

namespace quadrel {
namespace {

const Json* member(const Json* object, const std::string& key) {
    return object != nullptr && object->is_object() && object->contains(key) ? &(*object)[key]
                                                                             : nullptr;
}

std::string text_of(const Json* value) {
    return value != nullptr && value->is_string() ? value->get<std::string>() : "";
}

/// The id that `owner`, a material or its relief, names for a room; empty: the default stage.
std::string named_stage(const Json* owner, const std::string& room) {
    const Json* stage = member(owner, room);
    if (stage != nullptr) return text_of(stage->is_object() ? member(stage, "id") : stage);
    const Preset* preset = find_preset(text_of(member(owner, "preset")));
    if (preset == nullptr) return "";
    return room == "frame" ? preset->frame : room == "trace" ? preset->trace : "";
}

bool takes(const StageInfo& stage, const std::string& parameter) {
    return std::ranges::any_of(stage.parameters,
                               [&](const ParameterText& p) { return parameter == p.name; });
}

/// One room's choice, in the file and now.
struct Replacement {
    std::string before, after;

    /// Whether `parameter` went with the stage that is no longer there. What neither of them takes
    /// is a mistake, and is left for whoever plans to find.
    bool drops(const std::string& parameter) const {
        const StageInfo *old_stage = find_stage(before), *new_stage = find_stage(after);
        if (new_stage == nullptr && after != "none") return false;
        if (new_stage != nullptr && takes(*new_stage, parameter)) return false;
        return old_stage == nullptr || takes(*old_stage, parameter);
    }
};

class Dropper {
  public:
    explicit Dropper(SceneDocument& document) : document_(document) {}

    /// `path` is that of `owner`, whose stages `before` named.
    void visit(const Json* before, Json& owner, const std::string& path,
               const std::string& section) {
        if (!owner.is_object()) return;
        for (const SceneKey& row : scene_keys())
            if (row.section == section && row.below_section == "stage")
                visit_room(before, owner, path, std::string(row.key));
    }
    std::vector<std::string> notes;

  private:
    void visit_room(const Json* before, Json& owner, const std::string& path,
                    const std::string& room) {
        const Replacement replacement{named_stage(before, room), named_stage(&owner, room)};
        if (replacement.before == replacement.after) return;
        // Parameters of the search may stand in the relief itself.
        if (room == "trace") drop(replacement, owner, path);
        if (owner.contains(room)) drop(replacement, owner[room], join_key(path, room));
    }

    void drop(const Replacement& replacement, Json& owner, const std::string& path) {
        if (!owner.is_object()) return;
        std::vector<std::string> dropped;
        for (const auto& [key, value] : owner.items())
            if (value.is_number() && !document_.set_by_option(join_key(path, key)) &&
                find_scene_key("relief", key) == nullptr && replacement.drops(key))
                dropped.push_back(key);
        for (const std::string& key : dropped) owner.erase(key);
        if (dropped.empty()) return;
        notes.push_back(fmt::format("{}: dropped {}, which {} does not take", path,
                                    fmt::join(dropped, ", "), replacement.after));
    }

    SceneDocument& document_;
};

}  // namespace

std::vector<std::string> drop_replaced_parameters(const Json& before, SceneDocument& document) {
    Dropper dropper(document);
    const auto material = [&](const Json* old, Json& now, const std::string& path) {
        if (!now.is_object()) return;
        dropper.visit(old, now, path, "material");
        if (now.contains("relief"))
            dropper.visit(member(old, "relief"), now["relief"], join_key(path, "relief"), "relief");
    };
    Json& root = document.root;
    if (root.contains("material"))
        material(member(&before, "material"), root["material"], "material");
    if (root.contains("materials") && root["materials"].is_object())
        for (auto& [name, now] : root["materials"].items())
            material(member(member(&before, "materials"), name), now, join_key("materials", name));
    return std::move(dropper.notes);
}

}  // namespace quadrel
