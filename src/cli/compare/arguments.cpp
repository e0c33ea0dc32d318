#include "cli/compare/arguments.hpp"

#include <charconv>

#include "cli/common/arguments.hpp"
#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

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

}  // namespace

void select_channels(const std::string& list, Film& reference, Film& test) {
    keep_channels("--channels", parse_list("--channels", list), reference, test);
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
