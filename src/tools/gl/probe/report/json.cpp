#include <cmath>
#include <nlohmann/json.hpp>

#include "gl/probe/report/results.hpp"

namespace quadrel::gl {
namespace {

/// NaN and infinities as words: JSON has none.
nlohmann::ordered_json json_of(const std::array<float, 4>& numbers) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const float number : numbers)
        if (std::isfinite(number))
            json.push_back(number);
        else
            json.push_back(std::isnan(number) ? "NaN" : number > 0 ? "inf" : "-inf");
    return json;
}

nlohmann::ordered_json json_of(const Difference& difference) {
    return {{"pixel", difference.pixel},
            {"asked", json_of(difference.asked)},
            {"seen", json_of(difference.seen)},
            {"expected", json_of(difference.expected)}};
}

nlohmann::ordered_json json_of(const ProbeResult& result) {
    nlohmann::ordered_json json{
        {"id", result.probe.id}, {"asks", result.probe.asks}, {"permits", result.probe.permits}};
    if (result.missing.empty())
        json["seen"] = result.seen;
    else
        json["missing"] = result.missing;
    if (result.permitted) json["permitted"] = *result.permitted;
    if (!result.probe.not_modelled.empty()) json["not_modelled"] = result.probe.not_modelled;
    json["tolerance"] = result.probe.tolerance;
    json["answers"] = result.answers;
    for (const PresetResult& preset : result.presets) {
        nlohmann::ordered_json& one = json["presets"][preset.preset];
        one["does"] = preset.words;
        if (!result.missing.empty()) continue;
        one["agrees"] = preset.differing == 0;
        one["differing"] = preset.differing;
        if (preset.first) one["first"] = json_of(*preset.first);
    }
    return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Results& results) {
    nlohmann::ordered_json json{{"renderer", results.renderer},
                                {"version", results.version},
                                {"probes", nlohmann::ordered_json::array()}};
    for (const ProbeResult& result : results.probes) json["probes"].push_back(json_of(result));
    return json;
}

}  // namespace quadrel::gl
