#include "sweep/plan/plan_algorithms.hpp"

#include <algorithm>
#include <charconv>

#include "io/document/stage_parameters.hpp"
#include "quadrel/relief/registry.hpp"
#include "sweep/plan/families.hpp"
#include "sweep/plan/plan_values.hpp"

namespace quadrel::sweep {
namespace {

constexpr Word<Rows> row_words[] = {{"all", Rows::all},
                                    {"corrected", Rows::corrected},
                                    {"published", Rows::published},
                                    {"engines", Rows::engines},
                                    {"oracles", Rows::oracles}};

ParameterValue parameter_value(const SceneValue& value, const std::string& trace,
                               const std::string& name) {
    const ParameterText* text = find_parameter(trace, name);
    const ParameterValue given =
        value.json().is_string() ? ParameterValue(value.string()) : ParameterValue(value.number());
    if (!number_of(*text, given)) value.reject(expected_of(*text, given));
    return given;
}

std::vector<Parameters> read_parameters_of(const SceneValue& value, const std::string& trace) {
    if (!value.json().is_object()) value.reject("an object of parameters, each a value or a list");
    std::vector<std::string> known;
    for (const ParameterText& parameter : find_stage(trace)->parameters)
        known.emplace_back(parameter.name);
    std::vector<std::pair<std::string, std::vector<ParameterValue>>> lists;
    for (const auto& [name, member] : value.json().items()) {
        const SceneValue list = value.member(name);
        if (find_parameter(trace, name) == nullptr)
            list.fail("a parameter that " + trace + " does not take", one_of(name, known));
        lists.push_back({name, {}});
        for (const SceneValue& one : distinct_elements(list))
            lists.back().second.push_back(parameter_value(one, trace, name));
    }
    return products(value, lists);
}

std::map<double, double> read_published(const SceneValue& value) {
    std::map<double, double> published;
    if (!value.json().is_object())
        value.reject("an object of frames per second by angle, as {\"45\": 30}");
    for (const auto& [key, member] : value.json().items()) {
        double angle = 0;
        const auto [stop, error] = std::from_chars(key.data(), key.data() + key.size(), angle);
        if (error != std::errc() || stop != key.data() + key.size())
            value.member(key).fail("the key \"" + key + "\"", "an angle in degrees");
        if (!published.emplace(angle, value.member(key).number(above_zero)).second)
            value.member(key).fail(short_number(angle) + " degrees a second time", "each once");
    }
    return published;
}

std::string read_trace(const SceneValue& value) {
    const std::string id = value.string();
    const StageInfo* stage = find_stage(id == "none" ? "trace-none" : id);
    if (stage == nullptr || std::string_view(stage->text.room) != "trace")
        value.reject("a trace: " + one_of(id, trace_rows(Rows::all)));
    return stage->text.id;
}

/// An algorithm and the entry of the plan that has it: by its name, or as one of a group of rows.
struct PlannedAlgorithm {
    Algorithm algorithm;
    SceneValue entry;
    bool is_named;
};

void read_algorithm(const SceneValue& value, std::vector<PlannedAlgorithm>& all) {
    if (value.json().is_string()) {
        all.push_back({{read_trace(value), {}, {}}, value, true});
        return;
    }
    Fields fields(value);
    if (fields.has("rows")) {
        for (const std::string& id : trace_rows(fields.get("rows").word(row_words)))
            all.push_back({{id, {}, {}}, value, false});
        return fields.finish("an entry of rows");
    }
    const std::string trace = read_trace(fields.get("trace"));
    std::map<double, double> published;
    if (fields.has("published")) published = read_published(fields.get("published"));
    std::vector<Parameters> sets{{}};
    if (fields.has("parameters")) sets = read_parameters_of(fields.get("parameters"), trace);
    for (const Parameters& parameters : sets)
        all.push_back({{trace, parameters, published}, value, true});
    fields.finish("an algorithm");
}

/// Whether two are one search: a parameter that is not given has its default.
bool are_same(const Algorithm& a, const Algorithm& b) {
    if (a.trace != b.trace) return false;
    const auto value = [](const Algorithm& algorithm, const ParameterText& parameter) {
        const auto given = algorithm.parameters.find(parameter.name);
        if (given == algorithm.parameters.end()) return parameter.default_value;
        return *number_of(parameter, given->second);
    };
    return std::ranges::all_of(find_stage(a.trace)->parameters,
                               [&](const ParameterText& p) { return value(a, p) == value(b, p); });
}

/// Groups of rows may overlap, and hold what is named beside them: that is measured once, as it is
/// named. What is named twice is refused.
std::vector<Algorithm> each_once(const std::vector<PlannedAlgorithm>& all) {
    std::vector<PlannedAlgorithm> kept;
    for (const PlannedAlgorithm& one : all) {
        const auto same = std::ranges::find_if(kept, [&](const PlannedAlgorithm& other) {
            return are_same(one.algorithm, other.algorithm);
        });
        if (same == kept.end())
            kept.push_back(one);
        else if (one.is_named && same->is_named)
            one.entry.fail(one.algorithm.name() + " a second time: " + same->entry.path() +
                               " has " + same->algorithm.name(),
                           "each search with each set of parameters once");
        else if (one.is_named)
            *same = one;
    }
    std::vector<Algorithm> algorithms;
    for (const PlannedAlgorithm& one : kept) algorithms.push_back(one.algorithm);
    return algorithms;
}

}  // namespace

std::string Algorithm::name() const {
    std::string text = trace;
    for (const auto& [key, value] : parameters) text += " " + key + "=" + text_of(value);
    return text;
}

std::vector<Algorithm> read_algorithms(const std::vector<SceneValue>& entries) {
    std::vector<PlannedAlgorithm> all;
    for (const SceneValue& value : entries) read_algorithm(value, all);
    return each_once(all);
}

}  // namespace quadrel::sweep
