#include "io/document/replaced.hpp"

#include <fmt/format.h>

#include "io/document/keys.hpp"
#include "io/document/stage_parameters.hpp"
#include "io/document/stages.hpp"
#include "quadrel/relief/registry.hpp"

namespace quadrel {
namespace {

/// One room's choice, in the file and now.
struct Replacement {
    std::string before, after;

    /// Whether `parameter` went with the stage that is no longer there. What neither of them takes
    /// is a mistake, and is left for whoever plans to find.
    bool drops(const std::string& parameter) const {
        if (find_stage(after) == nullptr && after != "none") return false;
        if (find_parameter(after, parameter) != nullptr) return false;
        return find_stage(before) == nullptr || find_parameter(before, parameter) != nullptr;
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
        if (room == "trace") drop(replacement, owner, path, "relief");
        if (owner.contains(room)) drop(replacement, owner[room], join_key(path, room), "stage");
    }

    void drop(const Replacement& replacement, Json& owner, const std::string& path,
              const std::string& section) {
        if (!owner.is_object()) return;
        std::vector<std::string> dropped;
        for (const auto& [key, value] : owner.items())
            if (!value.is_object() && !document_.set_by_option(join_key(path, key)) &&
                find_scene_key(section, key) == nullptr && replacement.drops(key))
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
            dropper.visit(member_of(old, "relief"), now["relief"], join_key(path, "relief"),
                          "relief");
    };
    Json& root = document.root;
    if (root.contains("material"))
        material(member_of(&before, "material"), root["material"], "material");
    if (root.contains("materials") && root["materials"].is_object())
        for (auto& [name, now] : root["materials"].items())
            material(member_of(member_of(&before, "materials"), name), now,
                     join_key("materials", name));
    return std::move(dropper.notes);
}

}  // namespace quadrel
