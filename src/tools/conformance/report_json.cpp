#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "conformance/report.hpp"
#include "quadrel/error.hpp"

namespace quadrel::conformance {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Unexplained& pixel) {
    return {{"channel", pixel.channel},
            {"pixel", {pixel.x, pixel.y}},
            {"reference", fmt::format("{:#010x}", pixel.reference)},
            {"found", fmt::format("{:#010x}", pixel.found)},
            {"command", pixel.command}};
}

Unexplained pixel_of(const Json& json) {
    const auto bits = [&](const char* key) {
        return static_cast<std::uint32_t>(std::stoul(json.at(key).get<std::string>(), nullptr, 16));
    };
    return {json.at("channel"), json.at("pixel").at(0), json.at("pixel").at(1),
            bits("reference"),  bits("found"),          json.at("command")};
}

Json json_of(const GroupReport& group) {
    Json json = Json::object();
    for (std::size_t v = 0; v < verdict_count; ++v)
        if (group.counts[v] != 0) json[verdict_names[v]] = group.counts[v];
    for (const Unexplained& pixel : group.examples) json["examples"].push_back(json_of(pixel));
    if (!group.note.empty()) json["note"] = group.note;
    return json;
}

GroupReport group_of(const std::string& name, const Json& json) {
    GroupReport group{name, {}, {}, json.value("note", "")};
    for (std::size_t v = 0; v < verdict_count; ++v)
        group.counts[v] = json.value(verdict_names[v], std::uint64_t(0));
    for (const Json& pixel : json.value("examples", Json::array()))
        group.examples.push_back(pixel_of(pixel));
    return group;
}

Json json_of(const CaseReport& one) {
    Json json{{"row", one.row}, {"map", one.map}, {"angle", one.angle}};
    if (!one.refusal.empty()) json["refusal"] = one.refusal;
    if (!one.failure.empty()) json["failure"] = one.failure;
    for (const GroupReport& group : one.groups) json["groups"][group.name] = json_of(group);
    return json;
}

CaseReport case_of(const Json& json) {
    CaseReport one{json.at("row"),
                   json.at("map"),
                   json.at("angle"),
                   json.value("refusal", ""),
                   json.value("failure", ""),
                   {}};
    const Json groups = json.value("groups", Json::object());
    for (const auto& [name, group] : groups.items()) one.groups.push_back(group_of(name, group));
    return one;
}

}  // namespace

Json to_json(const Report& report) {
    Json json{{"renderer", report.renderer}, {"version", report.version},
              {"hardware", report.hardware}, {"limits", report.limits},
              {"size", report.size},         {"most_ranged", report.most_ranged},
              {"cases", Json::array()}};
    for (const CaseReport& one : report.cases) json["cases"].push_back(json_of(one));
    return json;
}

Report read_report(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string(), "", "no such file", "a report to go on with");
    try {
        const Json json = Json::parse(stream);
        Report report{json.at("renderer"),
                      json.at("version"),
                      json.at("hardware"),
                      json.at("limits"),
                      json.at("size"),
                      json.at("most_ranged"),
                      {}};
        for (const Json& one : json.at("cases")) report.cases.push_back(case_of(one));
        return report;
    } catch (const std::exception& error) {
        throw InputError(file.string(), "", error.what(), "a report of quadrel-conformance");
    }
}

}  // namespace quadrel::conformance
