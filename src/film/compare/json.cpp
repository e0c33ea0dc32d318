// A comparison for tools.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "film/compare/preparation.hpp"

namespace quadrel {
namespace {

using Json = nlohmann::ordered_json;

template <class Float>
Json finite_or_text(Float value) {
    return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value));
}

std::string bits_text(std::uint32_t bits) { return fmt::format("{:#010x}", bits); }

Json tolerance_json(const Tolerance& tolerance) {
    return {{"abs", tolerance.abs},
            {"rel", tolerance.rel},
            {"ulp", tolerance.ulp},
            {"fraction", tolerance.fraction}};
}

Json pixel_json(const ChannelReport& channel, const PixelDifference& pixel) {
    return {{"x", pixel.x},
            {"y", pixel.y},
            {"reference", value_json(channel.type, pixel.reference)},
            {"test", value_json(channel.type, pixel.test)},
            {"reference_bits", bits_text(pixel.reference)},
            {"test_bits", bits_text(pixel.test)}};
}

Json channel_json(const ChannelReport& channel) {
    Json json = {
        {"name", channel.name},
        {"type", channel.type == ChannelType::float32 ? "float" : "uint"},
        {"encoding", encoding_name(channel.encoding)},
        {"tolerance", tolerance_json(channel.tolerance)},
        {"passes", channel.passes()},
        {"pixels", channel.pixels},
        {"unequal", channel.unequal},
        {"differing", channel.differing},
        {"nan_mismatches", channel.nan_mismatches},
        {"infinite_mismatches", channel.infinite_mismatches},
        {"max_abs", channel.max_abs},
        {"mean_abs", channel.mean_abs},
        {"rms", channel.rms},
        {"psnr", number_json(channel.psnr)},
        {"max_ulp", channel.max_ulp},
        {"worst", Json::array()},
    };
    for (const PixelDifference& pixel : channel.worst)
        json["worst"].push_back(pixel_json(channel, pixel));
    return json;
}

Json window_json(const std::optional<Window>& window) {
    if (!window) return nullptr;
    return {window->x0, window->y0, window->x1, window->y1};
}

ChannelType type_of(const CompareReport& report, const std::string& name) {
    for (const ChannelReport& channel : report.channels)
        if (channel.name == name) return channel.type;
    return ChannelType::float32;
}

Json blame_json(const CompareReport& report, const Blame& blame) {
    const ChannelType type = type_of(report, blame.first);
    return {{"x", blame.x},
            {"y", blame.y},
            {"symptom", blame.symptom},
            {"first", blame.first},
            {"reference", value_json(type, blame.reference)},
            {"test", value_json(type, blame.test)},
            {"reference_bits", bits_text(blame.reference)},
            {"test_bits", bits_text(blame.test)},
            {"upstream", blame.upstream},
            {"command", blame.command},
            {"same_scene", blame.same_scene ? Json(*blame.same_scene) : Json()}};
}

}  // namespace

Json number_json(double value) { return finite_or_text(value); }
Json number_json(float value) { return finite_or_text(value); }

Json value_json(ChannelType type, std::uint32_t bits) {
    return type == ChannelType::uint32 ? Json(bits) : number_json(std::bit_cast<float>(bits));
}

Json preparation_json(const Preparation& preparation) {
    Json map = Json::object();
    for (const auto& [reference, test] : preparation.mappings) map[reference] = test;
    return {{"reference", preparation.reference_file},
            {"test", preparation.test_file},
            {"reference_storage", preparation.reference_storage},
            {"test_storage", preparation.test_storage},
            {"encode", encoding_name(preparation.encoding)},
            {"decoded", preparation.decoded},
            {"flip_y", preparation.flip_y},
            {"map", map},
            {"by_value", preparation.by_value},
            {"window", window_json(preparation.window)}};
}

std::string to_json(const CompareReport& report) {
    Json json = {{"equal", report.equal()}};
    if (report.preparation) json["preparation"] = preparation_json(*report.preparation);
    json["structure"] = report.structure;
    json["left_out"] = report.left_out;
    json["channels"] = Json::array();
    for (const ChannelReport& channel : report.channels)
        json["channels"].push_back(channel_json(channel));
    if (report.blame) json["blame"] = blame_json(report, *report.blame);
    // A file name may hold bytes that are no UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace quadrel
