#include "sweep/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "file/atomic_file.hpp"
#include "file/read_file.hpp"
#include "io/document/stage_parameters.hpp"
#include "sweep/plan/families.hpp"

namespace quadrel::sweep {
namespace {

Json json_of(const ParameterValue& value) {
    return value.name() ? Json(*value.name()) : Json(*value.number());
}

/// Columns of the shares of kinds.
constexpr std::pair<const char*, ErrorKind> share_columns[] = {
    {"same", ErrorKind::same},     {"late", ErrorKind::late},
    {"early", ErrorKind::early},   {"other_surface", ErrorKind::other_surface},
    {"missed", ErrorKind::missed}, {"invented", ErrorKind::invented}};

/// Six digits are more than any of it is good for.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

/// JSON has no NaN: what has no value is null.
Json measured(double value) { return std::isfinite(value) ? Json(rounded(value)) : Json(); }

/// The parameter that a ladder of step counts goes over: what is given and counts steps, but not
/// the least of them nor those of a refinement.
std::optional<double> step_count(const Algorithm& algorithm) {
    for (const auto& [name, value] : algorithm.parameters) {
        const bool counts = name.find("steps") != std::string::npos || name == "points" ||
                            name.find("samples") != std::string::npos || name == "iterations" ||
                            name == "max_layers";
        const bool refines = name.starts_with("binary") || name.starts_with("min") ||
                             name.starts_with("fine") || name.ends_with("normal");
        if (counts && !refines && value.number()) return *value.number();
    }
    return std::nullopt;
}

std::optional<double> published_fps(const Algorithm& algorithm, const View& view) {
    if (!view.angle) return std::nullopt;
    const auto found = algorithm.published.find(*view.angle);
    return found == algorithm.published.end() ? std::nullopt : std::optional(found->second);
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

bool is_run(const Json& record) {
    return record.is_object() && record.contains("key") && record["key"].is_string() &&
           record.contains("machine") && record["machine"].is_string() &&
           record.contains("algorithm") && record["algorithm"].is_string() &&
           record.contains("order") && record["order"].is_number();
}

void describe_algorithm(Json& record, const Plan& plan, const Run& run) {
    const Algorithm& algorithm = plan.algorithms[run.algorithm];
    record["algorithm"] = algorithm.name();
    record["trace"] = algorithm.trace;
    record["family"] = std::string(family_of(algorithm.trace));
    record["parameters"] = Json::object();
    for (const auto& [name, value] : algorithm.parameters)
        record["parameters"][name] = json_of(value);
    record["steps_asked"] = or_null(step_count(algorithm));
    record["published_fps"] = or_null(published_fps(algorithm, plan.views[run.view]));
    record["published_on"] = plan.published_on;
}

}  // namespace

Json describe_run(const Plan& plan, const Run& run, const Machine& machine) {
    const PlannedMap& map = plan.maps[run.map];
    const View& view = plan.views[run.view];
    Json record;
    record["plan"] = plan.title;
    record["scene"] = plan.scenes[run.scene].name;
    record["map"] = map.name;
    record["map_kind"] = map.source == PlannedMap::Source::made ? map.kind : map.name;
    record["map_width"] = map.size;
    record["map_height"] = map.size;
    record["view"] = view.name();
    record["angle"] = or_null(view.angle);
    describe_algorithm(record, plan, run);
    record["width"] = plan.width;
    record["height"] = plan.height;
    record["samples"] = plan.samples;
    record["number"] = run.number;
    record["isa"] = run.isa;
    record["threads"] = run.threads;
    record["repeats"] = plan.repeats;
    record["machine"] = machine.name();
    record["processor"] = machine.processor;
    record["host"] = machine.host;
    record["processors"] = machine.processors;
    record["build"] = machine.build;
    record["load"] = rounded(machine.load);
    return record;
}

void add_time(Json& record, const RunTime& time, int threads) {
    record["repeats"] = time.repeats;
    record["clock"] = threads == 1 ? "cpu" : "wall";
    record["draw_ms"] = rounded(time.draw.least);
    record["draw_ms_median"] = rounded(time.draw.median);
    record["kernel_ms"] = rounded(time.kernel.least);
    record["kernel_ms_median"] = rounded(time.kernel.median);
    record["trace_ms"] = rounded(time.trace);
    record["fps"] = rounded(time.draw.least > 0 ? 1e3 / time.draw.least : 0);
    record["load_ms"] = rounded(time.load_ms);
}

void add_counts(Json& record, const RunCounts& counts, const SearchCost& cost) {
    record["fragments"] = counts.fragments;
    record["helpers"] = counts.helpers;
    record["look_ups"] = rounded(counts.look_ups_in_all);
    record["look_ups_by_kind"] = Json::object();
    for (const auto& [kind, look_ups] : counts.look_ups)
        record["look_ups_by_kind"][kind] = rounded(look_ups);
    record["search_look_ups"] = rounded(cost.mean);
    record["lockstep_look_ups"] = rounded(cost.lockstep);
    record["steps"] = rounded(counts.steps);
    record["texels_touched"] = counts.texels;
    record["lines_touched"] = counts.lines;
}

void add_error(Json& record, const RunError& error) {
    const double judged = static_cast<double>(std::max<std::uint64_t>(1, error.judged));
    record["rays"] = error.judged;
    record["certified"] = measured(static_cast<double>(error.certified) / judged);
    const ErrorSpread &s = spread_of(error.search, "s"), &uv = spread_of(error.search, "uv"),
                      &drawn = spread_of(error.whole, "uv");
    record["s_median"] = measured(s.p50);
    record["s_p99"] = measured(s.p99);
    record["s_max"] = measured(s.most);
    record["texels_mean"] = measured(error.mean_texels);
    record["texels_median"] = measured(uv.p50);
    record["texels_p90"] = measured(uv.p90);
    record["texels_p99"] = measured(uv.p99);
    record["texels_p999"] = measured(uv.p999);
    record["texels_max"] = measured(uv.most);
    record["drawn_texels_median"] = measured(drawn.p50);
    record["drawn_texels_p99"] = measured(drawn.p99);
    record["drawn_texels_max"] = measured(drawn.most);
    record["wrong"] = measured(error.wrong);
    for (const auto& [name, kind] : share_columns)
        record[name] = measured(error.search.share(kind));
    record["other_cell"] =
        rounded(static_cast<double>(error.search.other_cell.value_or(0)) / judged);
    record["nan"] = measured(error.nan);
}

void write_record(const std::filesystem::path& folder, const Json& record) {
    AtomicFile file(folder / (record["key"].get<std::string>() + ".json"));
    const std::string text = record.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    file.write(text.data(), text.size());
    file.commit();
}

std::optional<Json> read_record(const std::filesystem::path& folder, const std::string& key) {
    const std::filesystem::path file = folder / (key + ".json");
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    Json record = Json::parse(read_whole_file(file), nullptr, false);
    if (!is_run(record) || record["key"] != key) return std::nullopt;
    return record;
}

std::vector<Json> read_records(const std::filesystem::path& folder) {
    std::vector<Json> records;
    std::error_code error;
    for (std::filesystem::directory_iterator i(folder, error), end; !error && i != end;
         i.increment(error)) {
        const std::filesystem::path file = i->path();
        if (file.extension() != ".json" || file.filename().string().starts_with(".")) continue;
        Json record = Json::parse(read_whole_file(file), nullptr, false);
        if (!is_run(record)) throw InputError(file.string(), "", "no run of a sweep", "one");
        records.push_back(std::move(record));
    }
    if (error) throw InputError(folder.string(), "", error.message(), "a folder of runs");
    std::stable_sort(records.begin(), records.end(), [](const Json& a, const Json& b) {
        return std::pair(a["order"].get<double>(), a["key"].get<std::string>()) <
               std::pair(b["order"].get<double>(), b["key"].get<std::string>());
    });
    return records;
}

}  // namespace quadrel::sweep
