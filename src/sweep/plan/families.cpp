#include "sweep/plan/families.hpp"

#include <algorithm>

#include "quadrel/relief/registry.hpp"
#include "quadrel/relief/stages.hpp"

namespace quadrel::sweep {
namespace {

template <class... S>
bool lists(StageList<S...>, std::string_view id) {
    return ((id == S::text.id) || ...);
}

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
    if (lists(OffsetStages(), trace)) return "offset";
    if (lists(MarchStages(), trace)) return "march";
    if (lists(ConeStages(), trace)) return "cone";
    if (lists(ExactStages(), trace)) return "exact";
    if (lists(LayerStages(), trace)) return "layer";
    if (lists(CurvedStages(), trace)) return "curved";
    if (lists(TableStages(), trace)) return "table";
    if (lists(ShellStages(), trace)) return "shell";
    if (lists(OracleTraceStages(), trace)) return "oracle";
    if (lists(EngineStages(), trace)) return "engine";
    return "other";
}

std::vector<std::string> trace_rows(Rows rows) {
    std::vector<std::string> ids;
    for (const StageInfo& stage : all_stages())
        if (std::string_view(stage.text.room) == "trace" && !stage.may_miss &&
            family_of(stage.text.id) != "layer" && belongs(stage, rows))
            ids.emplace_back(stage.text.id);
    return ids;
}

}  // namespace quadrel::sweep
