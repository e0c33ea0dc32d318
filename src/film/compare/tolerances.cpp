#include "film/compare/tolerances.hpp"

#include <algorithm>

#include "quadrel/error.hpp"
#include "text/suggest.hpp"

namespace quadrel {
namespace {

bool is_below(const std::string& channel, const std::string& group) {
    return channel.starts_with(group + ".");
}

bool is_integer(const std::string& channel, const Film& reference, const Film& test) {
    for (const Plane* plane : {reference.find(channel), test.find(channel)})
        if (plane != nullptr && plane->type == ChannelType::uint32) return true;
    return false;
}

void add_rule(const ToleranceRule& rule, const Film& reference, const Film& test,
              CompareRules& rules) {
    for (const std::string& name : matching_channels(rule.option, rule.channel, reference, test)) {
        const bool integer = is_integer(name, reference, test);
        if (integer && !rule.for_integers && name != rule.channel) continue;
        // What holds for all floats does not become an allowance for this integer.
        const Tolerance start =
            rules.tolerance_of(name, integer ? ChannelType::uint32 : ChannelType::float32);
        rule.assign(rules.channels.try_emplace(name, start).first->second);
    }
}

}  // namespace

std::set<std::string> matching_channels(const std::string& option, const std::string& request,
                                        const Film& reference, const Film& test) {
    if (reference.find(request) != nullptr || test.find(request) != nullptr) return {request};
    std::set<std::string> names;
    std::vector<std::string> known;
    for (const Film* film : {&reference, &test})
        for (const Plane& plane : film->planes) {
            known.push_back(plane.name);
            if (is_below(plane.name, request)) names.insert(plane.name);
        }
    if (!names.empty()) return names;
    const std::string nearest = nearest_word(request, known);
    throw UsageError(option + ": neither image has a channel \"" + request + "\"" +
                     (nearest.empty() ? "" : ", did you mean \"" + nearest + "\"?"));
}

void keep_channels(const std::string& option, const std::vector<std::string>& requests,
                   Film& reference, Film& test) {
    std::set<std::string> wanted;
    for (const std::string& request : requests)
        wanted.merge(matching_channels(option, request, reference, test));
    const auto unwanted = [&](const Plane& plane) { return wanted.count(plane.name) == 0; };
    std::erase_if(reference.planes, unwanted);
    std::erase_if(test.planes, unwanted);
}

CompareRules match_tolerances(std::span<const ToleranceRule> rules, const Film& reference,
                              const Film& test) {
    CompareRules matched;
    // First what is for all, since a channel's own entry starts from that.
    for (const ToleranceRule& rule : rules)
        if (rule.channel.empty()) rule.assign(matched.all);
    for (const ToleranceRule& rule : rules)
        if (!rule.channel.empty()) add_rule(rule, reference, test, matched);
    return matched;
}

}  // namespace quadrel
