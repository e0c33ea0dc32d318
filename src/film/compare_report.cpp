#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "quadrel/compare.hpp"

namespace quadrel {
namespace {

std::string value_text(ChannelType type, std::uint32_t bits) {
    if (type == ChannelType::uint32) return fmt::format("{}", bits);
    return fmt::format("{} ({:a})", std::bit_cast<float>(bits), std::bit_cast<float>(bits));
}

std::string channel_text(const ChannelReport& channel) {
    if (channel.differing == 0 && channel.max_abs == 0)
        return fmt::format("{:<20} equal\n", channel.name);
    std::string text = fmt::format("{:<20} {} of {} differ, max {:.6g}, mean {:.6g}, rms {:.6g}",
                                   channel.name, channel.differing, channel.pixels, channel.max_abs,
                                   channel.mean_abs, channel.rms);
    if (channel.type == ChannelType::float32) text += fmt::format(", {} ulp", channel.max_ulp);
    if (channel.nan_mismatches > 0)
        text += fmt::format(", NaN on one side: {}", channel.nan_mismatches);
    if (channel.infinite_mismatches > 0)
        text += fmt::format(", infinite: {}", channel.infinite_mismatches);
    if (channel.worst_x >= 0)
        text += fmt::format("\n{:<20} worst at {},{}: reference {}, test {}", "", channel.worst_x,
                            channel.worst_y, value_text(channel.type, channel.worst_reference),
                            value_text(channel.type, channel.worst_test));
    return text + "\n";
}

/// JSON has no NaN and no infinity: such values are the strings that fmt gives.
nlohmann::ordered_json value_json(ChannelType type, std::uint32_t bits) {
    if (type == ChannelType::uint32) return bits;
    const float value = std::bit_cast<float>(bits);
    if ((bits & 0x7f800000u) == 0x7f800000u) return fmt::format("{}", value);
    return value;
}

nlohmann::ordered_json channel_json(const ChannelReport& channel) {
    nlohmann::ordered_json json = {
        {"name", channel.name},
        {"type", channel.type == ChannelType::float32 ? "float" : "uint"},
        {"pixels", channel.pixels},
        {"differing", channel.differing},
        {"nan_mismatches", channel.nan_mismatches},
        {"infinite_mismatches", channel.infinite_mismatches},
        {"max_abs", channel.max_abs},
        {"mean_abs", channel.mean_abs},
        {"rms", channel.rms},
        {"max_ulp", channel.max_ulp},
        {"worst", nullptr},
    };
    if (channel.worst_x >= 0)
        json["worst"] = {{"x", channel.worst_x},
                         {"y", channel.worst_y},
                         {"reference", value_json(channel.type, channel.worst_reference)},
                         {"test", value_json(channel.type, channel.worst_test)}};
    return json;
}

}  // namespace

std::string to_text(const CompareReport& report) {
    std::string text;
    for (const std::string& line : report.structure) text += line + "\n";
    for (const ChannelReport& channel : report.channels) text += channel_text(channel);
    return text + (report.equal() ? "equal\n" : "different\n");
}

std::string to_json(const CompareReport& report) {
    nlohmann::ordered_json json = {{"equal", report.equal()},
                                   {"structure", report.structure},
                                   {"channels", nlohmann::ordered_json::array()}};
    for (const ChannelReport& channel : report.channels)
        json["channels"].push_back(channel_json(channel));
    return json.dump(2) + "\n";
}

}  // namespace quadrel
