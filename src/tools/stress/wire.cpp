#include "stress/wire.hpp"

namespace quadrel::stress {

std::string to_line(const SceneResult& result) {
    Json json;
    json["refused"] = result.refused;
    json["refusal"] = result.refusal;
    json["fragments"] = result.fragments;
    json["certified"] = result.certified;
    json["left_out"] = result.left_out;
    json["judged"] = result.judged;
    json["findings"] = json["statuses"] = json["departures"] = Json::array();
    for (const Finding& f : result.findings)
        json["findings"].push_back(Json::array({f.kind, f.where, f.detail}));
    for (const auto& [status, pixels] : result.statuses)
        json["statuses"].push_back(Json::array({status, pixels}));
    for (const Departure& d : result.departures)
        json["departures"].push_back(Json::array(
            {d.frame, d.trace, d.pixels, d.beyond, d.from_uv, d.from_frame, d.from_grazing,
             d.from_search, d.search_beyond, d.double_beyond, d.rays_99, d.searches_99}));
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SceneResult from_line(const std::string& line) {
    const Json json = Json::parse(line);
    SceneResult result;
    result.refused = json["refused"];
    result.refusal = json["refusal"];
    result.fragments = json["fragments"];
    result.certified = json["certified"];
    result.left_out = json["left_out"];
    result.judged = json["judged"];
    for (const Json& f : json["findings"]) result.findings.push_back({f[0], f[1], f[2]});
    for (const Json& s : json["statuses"]) result.statuses[s[0]] = s[1];
    for (const Json& d : json["departures"])
        result.departures.push_back(
            {d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8], d[9], d[10], d[11]});
    return result;
}

}  // namespace quadrel::stress
