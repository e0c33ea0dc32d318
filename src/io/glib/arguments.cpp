#include "io/glib/arguments.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

// "1.", ".10" and "+2" are numbers in glman's files; "inf" and "nan" are not.
std::optional<double> parse_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

constexpr int texture_units = 32;

}  // namespace

void GlibArguments::fail(TextPosition at, const std::string& found,
                         const std::string& expected) const {
    throw InputError(file_.string(), command_.name.text, found, expected, at.line, at.column);
}

const GlibWord& GlibArguments::word(std::string_view meaning) {
    if (!has_more()) fail(command_.end, "the end of the command", std::string(meaning));
    return command_.arguments[next_++];
}

GlibNumber GlibArguments::number(std::string_view meaning) {
    const GlibWord& here = word(meaning);
    const auto value = parse_number(here.text);
    if (!value) fail(here.at, quoted(here.text), "a number: " + std::string(meaning));
    return {*value, here.at};
}

GlibNumber GlibArguments::positive_number(std::string_view meaning) {
    const GlibNumber here = number(meaning);
    if (here.value <= 0)
        fail(here.at, quoted(command_.arguments[next_ - 1].text),
             "a number > 0: " + std::string(meaning));
    return here;
}

int GlibArguments::unit() {
    const GlibNumber here = number("a texture unit");
    if (!(here.value >= 0 && here.value < texture_units) || here.value != std::floor(here.value))
        fail(here.at, quoted(command_.arguments[next_ - 1].text),
             "a texture unit: a whole number from 0 to 31");
    return static_cast<int>(here.value);
}

GlibNumber GlibArguments::number_or_slider(std::string_view meaning) {
    if (!has_more() || command_.arguments[next_].text != "<") return number(meaning);
    return slider(meaning);
}

void GlibArguments::bracket(char which, std::string_view meaning) {
    const std::string expected = std::string(1, which) + " " + std::string(meaning);
    const GlibWord& here = word(expected);
    if (here.text != std::string(1, which)) fail(here.at, quoted(here.text), expected);
}

GlibNumber GlibArguments::slider(std::string_view meaning) {
    const std::string of = " of " + std::string(meaning);
    bracket('<', "before the range" + of);
    const GlibNumber least = number("the least value" + of);
    const GlibNumber value = number("the default value" + of);
    const GlibNumber most = number("the greatest value" + of);
    bracket('>', "behind the range" + of);
    if (!(least.value <= value.value && value.value <= most.value))
        fail(value.at, "a default outside of its range",
             "<least default greatest> in ascending order");
    return value;
}

void GlibArguments::finish(std::string_view signature) const {
    if (!has_more()) return;
    const GlibWord& here = command_.arguments[next_];
    fail(here.at, quoted(here.text) + " more",
         "no more than " + command_.name.text + " " + std::string(signature));
}

}  // namespace quadrel
