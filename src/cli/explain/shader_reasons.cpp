#include "cli/explain/shader_reasons.hpp"

#include <fmt/format.h>

#include <map>

#include "export/export.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

std::map<std::string, std::string, std::less<>> reasons_by_id() {
    std::map<std::string, std::string, std::less<>> reasons;
    try {
        for (const ExportRow& row : export_rows()) reasons.emplace(row.id, row.refusal);
    } catch (const UsageError&) {
        // Without the module nothing is known; `export` says what it lacks.
    }
    return reasons;
}

}  // namespace

std::optional<std::string> why_not_a_shader(std::string_view id) {
    static const auto reasons = reasons_by_id();
    const auto found = reasons.find(id);
    if (found == reasons.end()) return std::nullopt;
    return found->second;
}

void add_shader_reasons(ListRows& rows) {
    for (ListRow& row : rows) {
        const auto reason = why_not_a_shader(row.json["id"].get<std::string>());
        if (!reason) continue;
        row.json["not_a_shader"] = *reason;
        if (!reason->empty()) row.text += fmt::format("{:<13}not a shader: {}\n", "", *reason);
    }
}

}  // namespace quadrel::cli
