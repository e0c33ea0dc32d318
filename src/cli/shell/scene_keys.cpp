#include "cli/shell/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "cli/explain/markdown.hpp"
#include "file/read_file.hpp"
#include "io/document/json.hpp"
#include "io/document/keys.hpp"
#include "io/document/stage_parameters.hpp"
#include "io/scene/find_scene.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/presets.hpp"
#include "render/lists/parameter_text.hpp"

namespace quadrel::cli {
namespace {

/// The words in `backticks` of a text.
std::vector<std::string> marked_words(std::string_view text) {
    std::vector<std::string> words;
    while (true) {
        const std::size_t begin = text.find('`');
        if (begin == text.npos) return words;
        const std::size_t end = text.find('`', begin + 1);
        if (end == text.npos) return words;
        words.emplace_back(text.substr(begin + 1, end - begin - 1));
        text.remove_prefix(end + 1);
    }
}

/// Null where the scene cannot be read.
Json read_document(const std::string& scene) {
    try {
        const std::filesystem::path file = find_scene(scene);
        return parse_scene_text(read_whole_file(file), file).root;
    } catch (const std::exception&) {
        return {};
    }
}

std::string room_of(std::string_view key) {
    std::string room(key);
    std::replace(room.begin(), room.end(), '_', '-');
    return room;
}

/// A path on its way from the root: where the table and the scene are.
class KeyPath {
  public:
    explicit KeyPath(const Json& root) : at_(&root) {}

    /// Goes on by a part such as "materials" or "objects[0]". False where the format has none.
    bool descend(const std::string& part) {
        const std::size_t bracket = part.find('[');
        if (!descend_by_name(part.substr(0, bracket))) return false;
        if (bracket == std::string::npos) return true;
        if (below_ != Below::list) return false;
        below_ = Below::object;
        at_ = at_ != nullptr && at_->is_array() && !at_->empty() ? &at_->front() : nullptr;
        return true;
    }

    /// Where names of the user's stand next.
    bool wants_name() const { return below_ == Below::names; }
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        if (at_ != nullptr && at_->is_object())
            for (const auto& [name, member] : at_->items()) names.push_back(name);
        return names;
    }
    bool is_object() const { return below_ == Below::object; }
    std::string_view section() const { return section_; }
    const SceneKey* row() const { return row_; }
    /// The stage that the scene names here, of a relief for the trace.
    std::string stage() const {
        const Json* id = section_ == "relief" ? member(at_, "trace") : at_;
        if (const Json* const of_object = member(id, "id")) id = of_object;
        return id != nullptr && id->is_string() ? id->get<std::string>() : "";
    }
    std::string room() const { return section_ == "relief" ? "trace" : room_of(row_->key); }

  private:
    /// Null where there is none.
    static const Json* member(const Json* json, const std::string& name) {
        return json != nullptr && json->is_object() && json->contains(name) ? &(*json)[name]
                                                                            : nullptr;
    }

    bool descend_by_name(const std::string& name) {
        if (below_ == Below::names) {
            below_ = Below::object;
        } else {
            row_ = below_ == Below::object ? find_scene_key(section_, name) : nullptr;
            if (row_ == nullptr) return false;
            below_ = row_->below;
            section_ = row_->below_section;
        }
        at_ = member(at_, name);
        return true;
    }

    const Json* at_;
    const SceneKey* row_ = nullptr;
    std::string_view section_ = "scene";
    Below below_ = Below::object;
};

/// "a.b.c" as "a.b." and "c".
std::string path_before(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return dot == std::string::npos ? "" : path.substr(0, dot + 1);
}

/// Follows each part of "a.b."; false where the format has no such path.
bool descend_all(std::string_view path, KeyPath& at) {
    while (!path.empty()) {
        const std::size_t dot = path.find('.');
        if (!at.descend(std::string(path.substr(0, dot)))) return false;
        if (dot == path.npos) return true;
        path.remove_prefix(dot + 1);
    }
    return true;
}

/// The value that the last of the assignments to `key` gives; empty if there is none.
std::string defined_value(const std::vector<std::string>& defines, const std::string& key) {
    std::string value;
    for (const std::string& define : defines)
        if (define.starts_with(key + "=")) value = define.substr(key.size() + 1);
    return value;
}

/// Parameters of the stage that is chosen, or where nothing tells which that is of all that may be.
std::vector<const StageInfo*> stages_meant(const KeyPath& at, const std::string& path,
                                           const std::vector<std::string>& defines) {
    std::string key = path.substr(0, path.size() - 1);  // without the dot
    if (at.section() == "relief") key += ".trace";
    std::string id = defined_value(defines, key);
    if (id.empty()) id = defined_value(defines, key + ".id");
    if (id.empty()) id = at.stage();
    if (const StageInfo* const stage = find_stage(id)) return {stage};
    std::vector<const StageInfo*> stages;
    for (const StageInfo& stage : all_stages())
        if (at.room() == stage.text.room) stages.push_back(&stage);
    return stages;
}

void add_key(const std::string& path, const SceneKey& row, Candidates& to) {
    const std::string word = path + std::string(row.key), meaning = plain_text(row.meaning);
    const bool plain = row.below == Below::value || row.value.find("or ") != row.value.npos;
    if (plain) to.add(word + "=", meaning);
    if (row.below == Below::object || row.below == Below::names) to.add(word + ".", meaning);
    if (row.below == Below::list) to.add(word + "[0].", meaning);
}

void add_parameters(const std::string& path, const std::vector<const StageInfo*>& stages,
                    Candidates& to) {
    for (const StageInfo* const stage : stages)
        for (const ParameterText& parameter : stage->parameters) {
            const std::string word = path + std::string(parameter.name) + "=";
            const bool known = std::ranges::any_of(
                to.words, [&](const Candidate& candidate) { return candidate.word == word; });
            if (!known) to.add(word, parameter_text(parameter));
        }
}

void add_keys(const std::string& path, const std::string& before, const Json& document,
              const std::vector<std::string>& defines, Candidates& to) {
    KeyPath at(document);
    if (!descend_all(path, at)) return;
    if (at.wants_name()) {
        for (const std::string& name : at.names()) to.add(before + path + name + ".");
        return;
    }
    if (!at.is_object()) return;
    for (const SceneKey& row : scene_keys())
        if (row.section == at.section() && row.key != "quadrel") add_key(before + path, row, to);
    if (takes_parameters(at.section()))
        add_parameters(before + path, stages_meant(at, path, defines), to);
}

void add_stages(const std::string& before, std::string_view room, Candidates& to) {
    for (const StageInfo& stage : all_stages())
        if (stage.text.room == room)
            to.add(before + std::string(stage.text.id), stage.text.summary);
}

void add_parameter_values(const std::string& before, const ParameterText& parameter,
                          Candidates& to) {
    for (const ValueName& row : value_names(parameter)) to.add(before + std::string(row.name));
}

void add_values_of_key(const std::string& before, const SceneKey& row, Candidates& to) {
    if (row.key == "file") return to.add_files();
    if (row.below_section == "stage") {
        add_stages(before, room_of(row.key), to);
        if (row.section == "relief") to.add(before + "none");
        return;
    }
    if (row.key == "preset")
        for (const Preset& preset : all_presets()) to.add(before + preset.name, preset.summary);
    if (row.value == "boolean")
        for (const char* const word : {"false", "true"}) to.add(before + word);
    if (row.below != Below::value || row.key == "preset") return;
    for (const std::string& word : marked_words(row.value))
        if (word.find_first_of(" \"[") == std::string::npos) to.add(before + word);
}

void add_values(const std::string& key, const std::string& before, const Json& document,
                const std::vector<std::string>& defines, Candidates& to) {
    KeyPath at(document);
    if (descend_all(key, at)) {
        if (at.row() != nullptr && !at.wants_name()) add_values_of_key(before, *at.row(), to);
        return;
    }
    const std::string path = path_before(key), name = key.substr(path.size());
    KeyPath above(document);
    if (path.empty() || !descend_all(path, above) || !takes_parameters(above.section())) return;
    for (const StageInfo* const stage : stages_meant(above, path, defines))
        if (const ParameterText* const parameter = find_parameter(stage->text.id, name))
            return add_parameter_values(before, *parameter, to);
}

}  // namespace

void add_assignments(const std::string& begun, const std::string& before, const std::string& scene,
                     const std::vector<std::string>& defines, Candidates& to) {
    const Json document = scene.empty() ? Json() : read_document(scene);
    const std::size_t end = begun.find('=');
    if (end == std::string::npos)
        add_keys(path_before(begun), before, document, defines, to);
    else
        add_values(begun.substr(0, end), before + begun.substr(0, end + 1), document, defines, to);
}

void add_key_paths(const std::string& begun, Candidates& to) {
    const Json no_scene;
    KeyPath at(no_scene);
    const std::string path = path_before(begun);
    if (path.empty() || !descend_all(path, at) || !at.is_object()) return;
    for (const SceneKey& row : scene_keys())
        if (row.section == at.section())
            to.add(path + std::string(row.key), plain_text(row.meaning));
}

}  // namespace quadrel::cli
