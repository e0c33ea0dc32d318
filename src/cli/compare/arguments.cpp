#include "cli/compare/arguments.hpp"

#include <algorithm>
#include <charconv>

#include "cli/common/arguments.hpp"
#include "quadrel/error.hpp"
#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

bool is_below(const std::string& channel, const std::string& group) {
    return channel.starts_with(group + ".");
}

[[noreturn]] void reject(const std::string& option, const std::string& text,
                         const std::string& expected) {
    throw UsageError(option + ": found \"" + text + "\", expected " + expected);
}

/// "channel=value", or a value alone, whose channel is empty.
struct Assignment {
    std::string channel, value;
};

Assignment split_assignment(const std::string& text) {
    const std::size_t sign = text.find('=');
    if (sign == std::string::npos) return {"", text};
    return {text.substr(0, sign), text.substr(sign + 1)};
}

template <class Number>
Number parse_number(const std::string& option, const std::string& text, double most,
                    const std::string& expected) {
    Number value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const auto real = static_cast<double>(value);
    if (error != std::errc() || stop != end || !(real >= 0 && real <= most))
        reject(option, text, "[CHANNEL=]VALUE, the value " + expected);
    return value;
}

/// Reads the arguments of one option into rules that set one member of a tolerance.
template <class Number>
void parse_option(const std::string& option, const std::vector<std::string>& arguments,
                  Number Tolerance::*member, double most, const std::string& expected,
                  std::vector<ToleranceRule>& rules) {
    for (const std::string& text : arguments) {
        const Assignment assignment = split_assignment(text);
        if (text.starts_with('=')) reject(option, text, "[CHANNEL=]VALUE");
        const auto value = parse_number<Number>(option, assignment.value, most, expected);
        rules.push_back({option, assignment.channel, option == "--fraction",
                         [=](Tolerance& tolerance) { tolerance.*member = value; }});
    }
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

void select_channels(const std::string& list, Film& reference, Film& test) {
    std::set<std::string> wanted;
    for (const std::string& request : parse_list("--channels", list))
        wanted.merge(matching_channels("--channels", request, reference, test));
    const auto unwanted = [&](const Plane& plane) { return wanted.count(plane.name) == 0; };
    std::erase_if(reference.planes, unwanted);
    std::erase_if(test.planes, unwanted);
}

std::vector<ToleranceRule> parse_tolerances(const ToleranceArguments& arguments) {
    constexpr double most = 1e300, most_ulp = 0xffffffffu;
    std::vector<ToleranceRule> rules;
    parse_option("--abs", arguments.abs, &Tolerance::abs, most, "0 or more", rules);
    parse_option("--rel", arguments.rel, &Tolerance::rel, most, "0 or more", rules);
    parse_option("--ulp", arguments.ulp, &Tolerance::ulp, most_ulp, "an integer", rules);
    parse_option("--fraction", arguments.fraction, &Tolerance::fraction, 1, "0 to 1", rules);
    return rules;
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

std::vector<ChannelMapping> parse_mappings(std::span<const std::string> arguments) {
    std::vector<ChannelMapping> mappings;
    for (const std::string& text : arguments) {
        const Assignment assignment = split_assignment(text);
        if (assignment.channel.empty() || assignment.value.empty())
            reject("--map", text, "REFERENCE_CHANNEL=TEST_CHANNEL");
        mappings.push_back({assignment.channel, assignment.value});
    }
    return mappings;
}

}  // namespace quadrel::cli
