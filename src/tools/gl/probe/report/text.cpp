// The results as a table for a terminal, and in Markdown.
#include <fmt/format.h>

#include <algorithm>

#include "gl/probe/report/results.hpp"
#include "text/printable.hpp"

namespace quadrel::gl {
namespace {

/// "=" where a preset agrees, else what it does. Where that reads the same: how many answers
/// differ.
std::string cell(const ProbeResult& result, const PresetResult& preset) {
    if (!result.missing.empty()) return preset.words;
    if (preset.differing == 0) return "=";
    if (preset.words != result.seen) return preset.words;
    return fmt::format("{} of {} differ", preset.differing, result.answers);
}

/// "=" where a preset agrees, else "no".
std::string short_cell(const ProbeResult& result, const PresetResult& preset) {
    if (!result.missing.empty()) return "";
    return preset.differing == 0 ? "=" : "no";
}

std::string seen_cell(const ProbeResult& result) {
    if (!result.missing.empty())
        return "(" + printable(result.missing.substr(0, result.missing.find('\n'))) + ")";
    return result.seen + (result.permitted == false ? " (not permitted)" : "");
}

std::vector<std::vector<std::string>> rows_of(const Results& results, bool wide) {
    std::vector<std::vector<std::string>> rows(1);
    rows[0] = {"probe", "seen"};
    for (const std::string& name : preset_names()) rows[0].push_back(name);
    for (const ProbeResult& result : results.probes) {
        std::vector<std::string> row{result.probe.id, seen_cell(result)};
        for (const PresetResult& preset : result.presets)
            row.push_back(wide ? cell(result, preset) : short_cell(result, preset));
        rows.push_back(row);
    }
    return rows;
}

std::string count_line(const Results& results) {
    std::string text = "agrees, of what can be asked:";
    for (const std::string& name : preset_names()) {
        std::size_t asked = 0, agreed = 0;
        for (const ProbeResult& result : results.probes)
            for (const PresetResult& preset : result.presets) {
                if (preset.preset != name || !result.missing.empty()) continue;
                ++asked;
                agreed += preset.differing == 0;
            }
        text += fmt::format("  {} {}/{}", name, agreed, asked);
    }
    return text + "\n";
}

}  // namespace

std::string to_text(const Results& results, bool wide) {
    const auto rows = rows_of(results, wide);
    std::vector<std::size_t> width(rows[0].size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    std::string text = printable(results.renderer + ", OpenGL " + results.version) + "\n\n";
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += fmt::format("{:<{}}", row[i], i + 1 < row.size() ? width[i] + 2 : 0);
        text += line + "\n";
    }
    if (!wide)
        text += "\n--wide: what each preset does where it is not the same; --list: what is asked\n";
    return text + "\n" + count_line(results);
}

std::string to_markdown(const Results& results) {
    const auto rows = rows_of(results, true);
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        text += fmt::format("| {} |\n", fmt::join(rows[i], " | "));
        if (i > 0) continue;
        text += "|";
        for (std::size_t column = 0; column < rows[0].size(); ++column) text += "---|";
        text += "\n";
    }
    return text;
}

}  // namespace quadrel::gl
