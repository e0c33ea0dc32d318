#include "sweep/plan/families.hpp"

#include <algorithm>

#include "quadrel/relief/registry.hpp"
#include "quadrel/relief/stages.hpp"
#include "render/registry/is_listed.hpp"
#include "render/registry/judged_search.hpp"

namespace quadrel::sweep {
namespace {

/// Without the suffix, but one program's listing all the same.
bool is_one_programs(std::string_view id) { return id == "pom-dxsdk"; }

bool is_corrected(const StageInfo& stage, std::string_view family) {
    const std::string_view id = stage.text.id;
    const bool searches = family == "offset" || family == "march" || family == "cone" ||
                          family == "exact" || family == "other";
    return searches && id != "trace-none" && !id.ends_with("@published") &&
           stage.not_reproduced.empty() && !is_one_programs(id);
}

bool belongs(const StageInfo& stage, Rows rows) {
    const std::string_view family = family_of(stage.text.id);
    switch (rows) {
        case Rows::all:
            return true;
        case Rows::corrected:
            return is_corrected(stage, family);
        case Rows::engines:
            return family == "engine";
        case Rows::oracles:
            return family == "oracle";
        case Rows::published:
            break;
    }
    return family != "engine" && family != "oracle" && !is_corrected(stage, family) &&
           std::string_view(stage.text.id) != "trace-none";
}

}  // namespace

std::string_view family_of(std::string_view trace) {
    if (is_listed(OffsetStages(), trace)) return "offset";
    if (is_listed(MarchStages(), trace)) return "march";
    if (is_listed(ConeStages(), trace)) return "cone";
    if (is_listed(ExactStages(), trace)) return "exact";
    if (is_listed(LayerStages(), trace)) return "layer";
    if (is_listed(CurvedStages(), trace)) return "curved";
    if (is_listed(TableStages(), trace)) return "table";
    if (is_listed(ShellStages(), trace)) return "shell";
    if (is_listed(OracleTraceStages(), trace)) return "oracle";
    if (is_listed(EngineStages(), trace)) return "engine";
    return "other";
}

std::vector<std::string> trace_rows(Rows rows) {
    std::vector<std::string> ids;
    for (const StageInfo& stage : all_stages())
        if (std::string_view(stage.text.room) == "trace" && is_judged(stage) &&
            belongs(stage, rows))
            ids.emplace_back(stage.text.id);
    return ids;
}

}  // namespace quadrel::sweep
