#include "cli/explain/explain_key.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/explain/markdown.hpp"
#include "io/document/keys.hpp"
#include "quadrel/relief/registry.hpp"
#include "quadrel/scene/presets.hpp"
#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

/// "objects[0].mesh" as objects, mesh: what an index picks has no name of its own.
std::vector<std::string> parts_of(const std::string& path) {
    std::vector<std::string> parts(1);
    bool index = false;
    for (const char c : path) {
        if (c == '[') index = true;
        if (c == '.') parts.emplace_back();
        if (c != '.' && !index) parts.back() += c;
        if (c == ']') index = false;
    }
    return parts;
}

/// The row at the end of a path from the root; null if there is none.
const SceneKey* row_at(const std::vector<std::string>& parts) {
    std::string_view section = "scene";
    const SceneKey* row = nullptr;
    for (const std::string& part : parts) {
        const bool is_name = row != nullptr && row->below == Below::names;
        if (is_name) {
            row = nullptr;  // a name of the user's; its keys follow
            continue;
        }
        row = find_scene_key(section, part);
        if (row == nullptr) return nullptr;
        section = row->below_section;
    }
    return row;
}

std::string keys_text(std::string_view section) {
    std::string text;
    for (const std::string_view key : keys_of_section(section)) text += fmt::format(" {}", key);
    return text;
}

/// Rooms are named with dashes, keys with underscores.
std::string stages_text(std::string_view room) {
    std::string text;
    for (const StageInfo& stage : all_stages()) {
        std::string of_stage = stage.text.room;
        std::replace(of_stage.begin(), of_stage.end(), '-', '_');
        if (of_stage == room) text += fmt::format(" {}", stage.text.id);
    }
    return text;
}

std::string presets_text() {
    std::string text;
    for (const Preset& preset : all_presets()) text += " " + preset.name;
    return text;
}

void add_line(std::string& text, std::string_view label, std::string_view content) {
    if (!content.empty()) text += fmt::format("  {:<9}{}\n", label, plain_text(content));
}

std::string row_text(const SceneKey& row) {
    std::string text = fmt::format("{}: scene key of {}\n", row.key,
                                   row.section == "scene" ? "the whole scene" : row.section);
    add_line(text, "value", row.value);
    add_line(text, "default", row.standard);
    add_line(text, "meaning", row.meaning);
    if (row.below_section == "stage") {
        add_line(text, "stages", stages_text(row.key));
    } else if (!row.below_section.empty()) {
        add_line(text, "keys", keys_text(row.below_section));
    }
    if (row.key == "preset") add_line(text, "presets", presets_text());
    return text;
}

std::string section_text(std::string_view section) {
    std::string text = fmt::format("{}: section of scene files\n", section);
    add_line(text, "keys", keys_text(section));
    if (takes_parameters(section))
        add_line(text, "", "and the parameters of the stage: numbers, or names of them");
    return text;
}

}  // namespace

std::vector<std::string> explain_key(const std::string& word) {
    const std::vector<std::string> parts = parts_of(word);
    std::vector<std::string> texts;
    if (parts.size() > 1) {
        const SceneKey* row = row_at(parts);
        if (row == nullptr && parts.size() == 2) row = find_scene_key(parts[0], parts[1]);
        if (row != nullptr) texts.push_back(row_text(*row));
        return texts;
    }
    for (const SceneKey& row : scene_keys())
        if (row.key == word) texts.push_back(row_text(row));
    if (!keys_of_section(word).empty()) texts.push_back(section_text(word));
    return texts;
}

std::string nearest_path(const std::string& path) {
    std::string_view section = "scene";
    std::string nearest;
    bool is_name = false;
    for (const std::string& part : parts_of(path)) {
        const std::string key = is_name ? part : nearest_word(part, keys_of_section(section));
        if (key.empty()) return "";
        nearest += (nearest.empty() ? "" : ".") + key;
        if (is_name) {
            is_name = false;
            continue;
        }
        const SceneKey* row = find_scene_key(section, key);
        section = row->below_section;
        is_name = row->below == Below::names;
    }
    return nearest;
}

std::optional<ParameterPlace> parameter_place(const std::string& path) {
    std::vector<std::string> parts = parts_of(path);
    const std::string name = parts.back();
    if (parts.size() == 1) return ParameterPlace{"", name};
    parts.pop_back();
    const SceneKey* row = row_at(parts);
    if (row == nullptr || !takes_parameters(row->below_section)) return std::nullopt;
    std::string room = row->below_section == "relief" ? "trace" : std::string(row->key);
    std::replace(room.begin(), room.end(), '_', '-');
    return ParameterPlace{room, name};
}

}  // namespace quadrel::cli
