#include "quadrel/film/channels.hpp"

#include <algorithm>

#include "quadrel/error.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

constexpr std::string_view placeholder = "<i>";
constexpr std::size_t longest_index = 4;

bool is_index(const std::string& text) {
    return !text.empty() && text.size() <= longest_index && (text == "0" || text[0] != '0') &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Stands in the table for the channel that a range is of.
constexpr std::string_view any_channel = "<channel>";

/// Replaces the index in "shadow.2.visibility" by the table's placeholder; sets `index`.
std::string generic_name(const std::string& name, std::string& index) {
    const std::size_t begin = name.find('.');
    if (begin == std::string::npos) return name;
    const std::size_t end = std::min(name.find('.', begin + 1), name.size());
    const std::string part = name.substr(begin + 1, end - begin - 1);
    if (name.compare(0, begin, "shadow") != 0 || !is_index(part)) return name;
    index = part;
    return name.substr(0, begin + 1) + std::string(placeholder) + name.substr(end);
}

bool is_below(const std::string& name, const std::string& group) {
    return name.size() > group.size() && name.compare(0, group.size(), group) == 0 &&
           name[group.size()] == '.';
}

std::string with_index(std::string name, const std::string& index) {
    const std::size_t place = name.find(placeholder);
    if (place != std::string::npos) name.replace(place, placeholder.size(), index);
    return name;
}

/// What stands before the channel that a range is of, "gpu.lo" in "gpu.lo.K.U"; empty where the
/// name is of none.
std::string range_prefix(const std::string& name) {
    for (const char* prefix :
         {"gpu.lo", "gpu.hi", "gpu.paths", "gpu.gap.lo", "gpu.gap.hi", "bound.lo", "bound.hi"})
        if (name == prefix || is_below(name, prefix)) return prefix;
    return "";
}

/// "K.U" in "gpu.lo.K.U"; empty where nothing stands behind the prefix.
std::string behind(const std::string& name, const std::string& prefix) {
    return name.size() > prefix.size() ? name.substr(prefix.size() + 1) : "";
}

/// The channels of the table that lie in a group.
std::vector<std::string> members(const std::string& group) {
    std::string index;
    const std::string generic = generic_name(group, index);
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channel_table()) {
        if (channel.name.find(any_channel) != std::string::npos) continue;
        const bool per_light = channel.name.find(placeholder) != std::string::npos;
        if (per_light && index.empty()) continue;
        if (is_below(channel.name, generic)) names.push_back(with_index(channel.name, index));
    }
    return names;
}

/// Every full name that one request stands for; empty if there is none. A full name is never a
/// group as well: "B" is blue, not the bitangent. "gpu.lo.K" is the group K's with ranges.
std::vector<std::string> matches(const std::string& request) {
    if (find_channel(request) != nullptr) return {request};
    const std::string prefix = range_prefix(request);
    if (prefix.empty()) return members(request);
    std::vector<std::string> names;
    for (const std::string& name : members(behind(request, prefix)))
        if (has_range(name)) names.push_back(prefix + "." + name);
    return names;
}

std::vector<std::string> known_requests() {
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channel_table()) {
        if (channel.name.find(any_channel) != std::string::npos) continue;
        names.push_back(with_index(channel.name, "0"));
        const std::size_t dot = names.back().rfind('.');
        if (dot != std::string::npos) names.push_back(names.back().substr(0, dot));
    }
    return names;
}

[[noreturn]] void reject(const std::string& request) {
    const std::string prefix = range_prefix(request);
    const std::string of = prefix.empty() ? request : behind(request, prefix);
    const std::string nearest = nearest_word(of, known_requests());
    const std::string whole = nearest.empty() || prefix.empty() ? nearest : prefix + "." + nearest;
    std::string hint = whole.empty() || whole == request ? "" : ", did you mean \"" + whole + "\"?";
    if (!prefix.empty() && of.empty())
        hint = " of which it is the range, as in \"" + prefix + ".K\"";
    else if (!prefix.empty() && whole == request)
        hint = " of floats, which have ranges";
    throw UsageError("channels: found \"" + request + "\", expected a channel or group" + hint +
                     " (see `quadrel list channels`)");
}

}  // namespace

const ChannelInfo* find_channel(const std::string& name) {
    std::string index;
    const auto range = range_channel(name);
    const std::string of_table =
        range ? range->set + "." + range->part + "." + std::string(any_channel)
              : generic_name(name, index);
    if (name.find('<') != std::string::npos) return nullptr;
    for (const ChannelInfo& channel : channel_table())
        if (channel.name == of_table) return &channel;
    return nullptr;
}

bool is_exact_derivative(const std::string& name) {
    return is_below(name, "exact") || is_below(name, "derr");
}

bool is_error_channel(const std::string& name) { return is_below(name, "err"); }

std::optional<RangeChannel> range_channel(const std::string& name) {
    const std::string prefix = range_prefix(name), channel = behind(name, prefix);
    if (prefix.empty() || channel.empty() || !has_range(channel)) return std::nullopt;
    const std::size_t dot = prefix.find('.');
    return RangeChannel{prefix.substr(0, dot), prefix.substr(dot + 1), channel};
}

bool has_range(const std::string& channel) {
    if (channel == "Z") return true;
    if (channel == "A" || channel == "depth" || is_exact_derivative(channel) ||
        is_error_channel(channel) || is_integral_channel(channel) || is_below(channel, "oracle") ||
        is_below(channel, "gpu") || is_below(channel, "bound"))
        return false;
    const ChannelInfo* const info = find_channel(channel);
    return info != nullptr && info->type == ChannelType::float32;
}

bool needs_ranges(const std::string& name) {
    return name == "undecided" || name == "certified.pixel" || is_below(name, "gpu") ||
           is_below(name, "bound") || is_below(name, "certified.pixel");
}

bool is_integral_channel(const std::string& name) { return is_below(name, "integral"); }

bool is_drawn_apart(const std::string& name) {
    return is_exact_derivative(name) || is_error_channel(name) || needs_ranges(name) ||
           is_integral_channel(name);
}

const std::vector<std::string>& integral_channels() {
    static const std::vector<std::string> names{"R",
                                                "G",
                                                "B",
                                                "A",
                                                "integral.error.R",
                                                "integral.error.G",
                                                "integral.error.B",
                                                "integral.samples"};
    return names;
}

std::vector<std::string> expand_channels(std::span<const std::string> requests) {
    if (requests.empty()) return default_channels();
    std::vector<std::string> all;
    for (const std::string& request : requests) {
        const std::vector<std::string> names = matches(request);
        if (names.empty()) reject(request);
        for (const std::string& name : names)
            if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
    }
    return all;
}

std::uint32_t uncovered_bits(const std::string& name) {
    constexpr std::uint32_t infinity = 0x7f800000u;
    if (name == "Z") return infinity;
    return is_below(name, "id") ? 0xffffffffu : 0u;
}

}  // namespace quadrel
