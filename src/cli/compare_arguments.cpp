#include "cli/compare_arguments.hpp"

#include <algorithm>
#include <charconv>
#include <functional>

#include "cli/arguments.hpp"
#include "io/suggest.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

bool is_below(const std::string& channel, const std::string& group) {
    return channel.starts_with(group + ".");
}

[[noreturn]] void reject(const std::string& option, const std::string& text,
                         const std::string& expected) {
    throw UsageError(option + ": found \"" + text + "\", expected " + expected);
}

/// An argument with the channel that it is for, "" for all.
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
        reject(option, text, "[CHANNEL=]VALUE, " + expected);
    return value;
}

/// One of the four kinds of tolerance.
struct Kind {
    std::string option;
    const std::vector<std::string>& arguments;
    bool integers;  ///< whether a group's integer channels are meant too
    std::function<void(Tolerance&, const std::string&)> assign;
};

std::vector<Kind> kinds(const ToleranceArguments& arguments) {
    constexpr double most = 1e300;
    const std::string real = "a number of 0 or more", share = "0 to 1";
    return {
        {"--abs", arguments.abs, false,
         [=](Tolerance& t, const std::string& v) {
             t.abs = parse_number<double>("--abs", v, most, real);
         }},
        {"--rel", arguments.rel, false,
         [=](Tolerance& t, const std::string& v) {
             t.rel = parse_number<double>("--rel", v, most, real);
         }},
        {"--ulp", arguments.ulp, false,
         [](Tolerance& t, const std::string& v) {
             t.ulp = parse_number<std::uint32_t>("--ulp", v, 0xffffffffu, "an integer");
         }},
        {"--fraction", arguments.fraction, true,
         [=](Tolerance& t, const std::string& v) {
             t.fraction = parse_number<double>("--fraction", v, 1, share);
         }},
    };
}

bool is_integer(const std::string& channel, const Film& reference, const Film& test) {
    const Plane* plane = reference.find(channel);
    if (plane == nullptr) plane = test.find(channel);
    return plane != nullptr && plane->type == ChannelType::uint32;
}

void add_rule(const Kind& kind, const Assignment& assignment, const Film& reference,
              const Film& test, CompareRules& rules) {
    for (const std::string& name :
         matching_channels(kind.option, assignment.channel, reference, test)) {
        const bool integer = is_integer(name, reference, test);
        if (integer && !kind.integers && name != assignment.channel) continue;
        // What holds for all floats does not become an allowance for this integer.
        const Tolerance start =
            rules.tolerance_of(name, integer ? ChannelType::uint32 : ChannelType::float32);
        kind.assign(rules.channels.try_emplace(name, start).first->second, assignment.value);
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

CompareRules parse_tolerances(const ToleranceArguments& arguments, const Film& reference,
                              const Film& test) {
    CompareRules rules;
    // First what is for all, since a channel's own entry starts from that.
    for (const bool for_all : {true, false})
        for (const Kind& kind : kinds(arguments))
            for (const std::string& text : kind.arguments) {
                const Assignment assignment = split_assignment(text);
                if ((text.find('=') == std::string::npos) != for_all) continue;
                if (for_all) {
                    kind.assign(rules.all, assignment.value);
                } else {
                    add_rule(kind, assignment, reference, test, rules);
                }
            }
    return rules;
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

std::string shell_word(const std::string& word) {
    const auto plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view("-_./=,:+@%").find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

}  // namespace quadrel::cli
