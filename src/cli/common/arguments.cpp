#include "cli/common/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

constexpr int largest_side = 65536;

[[noreturn]] void reject(const std::string& option, const std::string& text,
                         const std::string& expected) {
    throw UsageError(option + ": found \"" + text + "\", expected " + expected);
}

/// Without the blanks around it.
std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(separator, from), text.size());
        parts.push_back(trimmed(text.substr(from, to - from)));
        from = to + 1;
    }
    return parts;
}

/// Where the value that begins at `from` ends: at a comma outside of brackets, braces and quotes,
/// or at the end of the text. A bracket that is never closed takes the rest.
std::size_t end_of_value(const std::string& text, std::size_t from) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = from; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == '[' || c == '{') ++depth;
        if (c == ']' || c == '}') --depth;
        if (c == ',' && depth <= 0) return i;
    }
    return text.size();
}

std::optional<int> parse_side(const std::string& text) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || value < 0 || value > largest_side)
        return std::nullopt;
    return value;
}

}  // namespace

std::vector<std::string> parse_list(const std::string& option, const std::string& text) {
    std::vector<std::string> parts = split(text, ',');
    for (const std::string& part : parts)
        if (part.empty()) reject(option, text, "names separated by commas");
    return parts;
}

std::vector<std::string> parse_values(const std::string& option, const std::string& text) {
    std::vector<std::string> values;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t end = end_of_value(text, from);
        values.push_back(trimmed(text.substr(from, end - from)));
        if (values.back().empty()) reject(option, text, "values separated by commas");
        from = end + 1;
    }
    return values;
}

Size parse_size(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, 'x');
    constexpr const char* expected = "WIDTHxHEIGHT, 1 to 65536 each";
    if (parts.size() != 2) reject(option, text, expected);
    const auto width = parse_side(parts[0]), height = parse_side(parts[1]);
    if (width.value_or(0) < 1 || height.value_or(0) < 1) reject(option, text, expected);
    return {*width, *height};
}

Window parse_window(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    constexpr const char* expected = "x0,y0,x1,y1 with 0 <= x0 < x1 and 0 <= y0 < y1";
    if (parts.size() != 4) reject(option, text, expected);
    int sides[4];
    for (std::size_t i = 0; i < 4; ++i) {
        const auto side = parse_side(parts[i]);
        if (!side) reject(option, text, expected);
        sides[i] = *side;
    }
    const Window window{sides[0], sides[1], sides[2], sides[3]};
    if (window.width() < 1 || window.height() < 1) reject(option, text, expected);
    return window;
}

Pixel parse_pixel(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    constexpr const char* expected = "x,y, both 0 or more";
    if (parts.size() != 2) reject(option, text, expected);
    const auto x = parse_side(parts[0]), y = parse_side(parts[1]);
    if (!x || !y) reject(option, text, expected);
    return {*x, *y};
}

Task parse_task(const std::string& text) {
    if (text.empty()) return {};
    const std::vector<std::string> parts = split(text, '/');
    // A script's mistake, and the name of a part has no blanks.
    const bool blanks = text.find(' ') != std::string::npos;
    const auto number = parse_side(parts[0]);
    const auto of = parts.size() == 2 ? parse_side(parts[1]) : std::nullopt;
    if (blanks || !number || !of || *number < 1 || *number > *of)
        reject("--task", text, "I/N with 1 <= I <= N, as 3/8");
    return {*number, *of};
}

std::vector<std::string> with_size(std::vector<std::string> overrides, const std::string& size) {
    if (size.empty()) return overrides;
    const auto [width, height] = parse_size("--size", size);
    overrides.push_back(fmt::format("size=[{},{}]", width, height));
    return overrides;
}

}  // namespace quadrel::cli
