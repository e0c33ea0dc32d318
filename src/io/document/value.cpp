#include "io/document/value.hpp"

#include <fmt/format.h>

#include <charconv>

#include "quadrel/error.hpp"
#include "text/not_finite.hpp"

namespace quadrel {
namespace {

/// Whether all of the text is a number beyond double.
bool overflows(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc::result_out_of_range && stop == end;
}

}  // namespace

std::string Range::text(std::string_view kind) const {
    const bool low_bound = std::isfinite(low), high_bound = std::isfinite(high);
    const char* left = open ? "(" : "[";
    const char* right = open ? ")" : "]";
    if (low_bound && high_bound)
        return fmt::format("{} in {}{}, {}{}", kind, left, low, high, right);
    if (low_bound) return fmt::format("{} {} {}", kind, open ? ">" : ">=", low);
    return std::string(kind);
}

std::string describe(const Json& json) {
    if (json.is_object()) return "an object";
    if (json.is_array()) return fmt::format("an array of {}", json.size());
    if (json.is_null()) return "null";
    // JSON has no word for NaN and infinities, and dump() says null.
    if (json.is_number_float() && !std::isfinite(json.get<double>()))
        return not_finite_name(json.get<double>());
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return (json.is_string() ? "the string " : json.is_number() ? "the number " : "") + text;
}

void SceneValue::fail(const std::string& found, const std::string& expected) const {
    const bool from_option = document_->set_by_option(path_);
    const TextPosition at = from_option ? TextPosition{} : document_->position_of(path_);
    throw InputError(document_->file.string(), path_, found + (from_option ? " (set by -D)" : ""),
                     expected, at.line, at.column);
}

void SceneValue::reject(const std::string& expected) const {
    // What -D cannot read as JSON it takes for a string.
    if (json_->is_string() && document_->set_by_option(path_)) {
        const std::string text = json_->get<std::string>();
        if (spells_not_finite(text)) fail(text, expected);
        if (overflows(text)) fail("the number " + text, expected + " that float64 can hold");
    }
    fail(describe(*json_), expected);
}

double SceneValue::number(Range range) const {
    if (!json_->is_number()) reject(range.text("a number"));
    const double value = json_->get<double>();
    if (!std::isfinite(value) || !range.contains(value)) reject(range.text("a number"));
    return value;
}

float SceneValue::real(Range range) const {
    const double value = number(range);
    if (std::abs(value) > std::numeric_limits<float>::max())
        reject("a number within the range of float32");
    return static_cast<float>(value);
}

int SceneValue::integer(int low, int high) const {
    const std::string expected = fmt::format("an integer in [{}, {}]", low, high);
    if (!json_->is_number()) reject(expected);
    const double value = json_->get<double>();
    if (!(value >= low && value <= high) || value != std::floor(value)) reject(expected);
    return static_cast<int>(value);
}

bool SceneValue::boolean() const {
    if (!json_->is_boolean()) reject("true or false");
    return json_->get<bool>();
}

std::string SceneValue::string() const {
    if (!json_->is_string()) reject("a string");
    return json_->get<std::string>();
}

std::vector<double> SceneValue::numbers(std::size_t least, std::size_t most, Range range) const {
    if (!json_->is_array() || json_->size() < least || json_->size() > most)
        reject(least == most ? fmt::format("an array of {} numbers", least)
                             : fmt::format("an array of {} to {} numbers", least, most));
    std::vector<double> values;
    for (std::size_t i = 0; i < json_->size(); ++i) {
        element(i).real(range);  // refuses what float32 cannot hold
        values.push_back(element(i).number(range));
    }
    return values;
}

glm::vec3 SceneValue::vector3(Range range) const {
    const auto values = numbers(3, 3, range);
    return {static_cast<float>(values[0]), static_cast<float>(values[1]),
            static_cast<float>(values[2])};
}

Fields::Fields(const SceneValue& value) : value_(value) {
    if (!value.json().is_object()) value.reject("an object { ... }");
}

SceneValue Fields::get(const std::string& key) {
    if (!has(key)) value_.fail("no \"" + key + "\"", "it, since it has no default");
    taken_.insert(key);
    return value_.member(key);
}

void Fields::read(const std::string& key, float& out, Range range) {
    if (has(key)) out = get(key).real(range);
}
void Fields::read(const std::string& key, double& out, Range range) {
    if (has(key)) out = get(key).number(range);
}
void Fields::read(const std::string& key, int& out, int low, int high) {
    if (has(key)) out = get(key).integer(low, high);
}
void Fields::read(const std::string& key, bool& out) {
    if (has(key)) out = get(key).boolean();
}
void Fields::read(const std::string& key, std::string& out) {
    if (has(key)) out = get(key).string();
}
void Fields::read(const std::string& key, glm::vec3& out, Range range) {
    if (has(key)) out = get(key).vector3(range);
}
void Fields::read(const std::string& key, glm::vec4& out, Range range) {
    if (!has(key)) return;
    const auto values = get(key).numbers(3, 4, range);
    for (std::size_t i = 0; i < values.size(); ++i)
        out[static_cast<int>(i)] = static_cast<float>(values[i]);
}

std::vector<std::string> Fields::rest() {
    std::vector<std::string> keys;
    for (const auto& [key, member] : value_.json().items())
        if (taken_.insert(key).second) keys.push_back(key);
    return keys;
}

void Fields::finish(const std::string& owner) {
    for (const std::string& key : rest())
        value_.member(key).fail("a key that " + owner + " does not take",
                                "it for another type, or to be left out");
}

}  // namespace quadrel
