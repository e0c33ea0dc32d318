// A probe's report for tools.
#include <fmt/format.h>

#include <cmath>

#include <bit>
#include <nlohmann/json.hpp>

#include "quadrel/probe.hpp"

namespace quadrel {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN and no infinities: null, and the bits say which.
Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json lanes(const std::array<float, 4>& v) {
    Json values = Json::array(), bits = Json::array();
    for (const float x : v) {
        values.push_back(number(x));
        bits.push_back(fmt::format("{:#010x}", std::bit_cast<std::uint32_t>(x)));
    }
    return {{"lanes", values}, {"bits", bits}};
}

Json to_json(const ProbeValue& value) {
    if (value.integer) return {{"lanes", value.whole}};
    return lanes(value.real);
}

Json to_json(const LaneFootprint& footprint) {
    const LaneLod& lod = footprint.lod;
    Json taps = Json::array();
    for (const TexelTap& tap : footprint.taps)
        taps.push_back({{"level", tap.level},
                        {"x", tap.x},
                        {"y", tap.y},
                        {"border", tap.border},
                        {"weight", tap.weight},
                        {"value",
                         {number(tap.value[0]), number(tap.value[1]), number(tap.value[2]),
                          number(tap.value[3])}}});
    return {{"rho", number(lod.rho)},     {"lambda", number(lod.lambda)},
            {"level", number(lod.level)}, {"frac", number(lod.frac)},
            {"magnified", lod.magnified}, {"taps", taps}};
}

Json to_json(const ProbeFetch& fetch) {
    Json out{{"texture", fetch.texture},
             {"active", fetch.active},
             {"u", lanes(fetch.u)},
             {"v", lanes(fetch.v)}};
    for (int lane = 0; lane < 4; ++lane) {
        out["value"].push_back(lanes(fetch.value[lane])["lanes"]);
        out["footprint"].push_back(to_json(fetch.footprint[lane]));
    }
    return out;
}

Json to_json(const ProbeStep& step) {
    return {{"active", step.active},
            {"s", lanes(step.s)},
            {"u", lanes(step.u)},
            {"v", lanes(step.v)},
            {"ray_height", lanes(step.ray_height)},
            {"map_height", lanes(step.map_height)},
            {"fetches_end", step.fetches_end}};
}

Json values(const std::vector<ProbeValue>& list) {
    Json out = Json::object();
    for (const ProbeValue& value : list) out[value.name] = to_json(value);
    return out;
}

Json to_json(const ProbeStage& stage) {
    Json out{{"id", stage.id}};
    if (stage.light >= 0) out["light"] = stage.light;
    out["outputs"] = values(stage.outputs);
    for (const ProbeStep& step : stage.steps) out["steps"].push_back(to_json(step));
    for (const ProbeFetch& fetch : stage.fetches) out["fetches"].push_back(to_json(fetch));
    return out;
}

Json to_json(const ProbeFragment& fragment) {
    Json out{{"object", fragment.object},
             {"object_name", fragment.object_name},
             {"primitive", fragment.primitive},
             {"material", fragment.material},
             {"covered", fragment.covered},
             {"visible", fragment.visible},
             {"edges", fragment.edges},
             {"depth", lanes(fragment.depth)},
             {"derivatives", values(fragment.derivatives)}};
    for (const ProbeStage& stage : fragment.stages) out["stages"].push_back(to_json(stage));
    return out;
}

}  // namespace

std::string to_json(const ProbeReport& report) {
    Json out{{"image", {report.image_x, report.image_y}},
             {"window", {report.window_x, report.window_y}},
             {"quad", {report.quad_x, report.quad_y}},
             {"lane", report.lane},
             {"samples", report.samples},
             {"conventions", report.conventions},
             {"number", report.number},
             {"isa", report.isa},
             {"fragments", Json::array()}};
    for (const ProbeFragment& fragment : report.fragments)
        out["fragments"].push_back(to_json(fragment));
    return out.dump(2) + "\n";
}

}  // namespace quadrel
