#include "export/stages/named_parameters.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "export/stages/stage_text.hpp"

namespace quadrel::recorded {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Numbers, words, and whatever else one character at a time.
std::vector<std::string> tokens_of(const std::string& text) {
    std::vector<std::string> tokens;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        if (std::isdigit(static_cast<unsigned char>(text[i])) != 0) {
            while (end < text.size() &&
                   (is_word(text[end]) || text[end] == '.' ||
                    (std::strchr("+-", text[end]) != nullptr && text[end - 1] == 'e')))
                ++end;
        } else if (is_word(text[i])) {
            while (end < text.size() && is_word(text[end])) ++end;
        }
        tokens.push_back(text.substr(i, end - i));
        i = end;
    }
    return tokens;
}

/// The number that a token is.
std::optional<double> number_of(const std::string& token) {
    if (std::isdigit(static_cast<unsigned char>(token[0])) == 0) return std::nullopt;
    return std::strtod(token.c_str(), nullptr);
}

bool is_real(const std::string& token) { return token.find_first_of(".e") != std::string::npos; }

/// What a token is more than a value: 0, or for whole numbers -1 or 1.
std::optional<int> offset_from(const std::string& token, double value, bool is_integer) {
    const std::optional<double> number = number_of(token);
    if (!number) return std::nullopt;
    if (!is_integer)
        return static_cast<float>(*number) == static_cast<float>(value) ? std::optional(0)
                                                                        : std::nullopt;
    const double offset = *number - value;
    return offset == 0 || offset == 1 || offset == -1 ? std::optional(static_cast<int>(offset))
                                                      : std::nullopt;
}

/// `name + offset`, of the type of the token that it replaces.
std::string expression(const std::string& name, int offset, const std::string& token,
                       bool is_integer) {
    std::string text = name;
    if (offset != 0) text += offset > 0 ? " + 1" : " - 1";
    if (is_integer && is_real(token)) return "float(" + text + ")";
    return offset != 0 ? "(" + text + ")" : text;
}

}  // namespace

NamedParameters::NamedParameters(const RecordedStage& stage, const void* params)
    : stage_(stage), params_(stage.params_size / sizeof(std::max_align_t) + 1) {
    if (params != nullptr)
        std::memcpy(params_.data(), params, stage.params_size);
    else
        stage.make_params(params_.data());
    for (int i = 0; i < stage.parameter_count; ++i) {
        const std::string name = as_word(stage.parameters[i].name);
        names_.push_back(is_reserved(name) ? name + "_" : name);
    }
}

NamedParameters::Params NamedParameters::with(int parameter, double value) const {
    Params params = params_;
    stage_.parameters[parameter].set(params.data(), value);
    return params;
}

void NamedParameters::odd_values(int parameter, double (&odd)[odd_count]) const {
    const ParameterText& text = stage_.parameters[parameter];
    const double range = text.maximum - text.minimum;
    const double part[odd_count] = {0.30078125, 0.61328125, 0};
    for (int i = 0; i < odd_count; ++i) {
        odd[i] = text.minimum + std::min(range, 4096.0) * part[i];
        if (part[i] == 0) odd[i] += text.integer ? 2 : std::min(range, 4.0) * 0.0087890625;
        if (text.integer) odd[i] = std::floor(odd[i]);
        odd[i] = static_cast<float>(odd[i]);
    }
}

NamedParameters::Places NamedParameters::places_of(int parameter,
                                                   const std::vector<std::string>& tokens,
                                                   const Write& write) const {
    const ParameterText& text = stage_.parameters[parameter];
    double odd[odd_count];
    odd_values(parameter, odd);
    // A choice, and what has few values, is decided by branches.
    if (text.value_names != nullptr || std::fabs(odd[1] - odd[0]) < (text.integer ? 3 : 0))
        return {};
    std::vector<std::string> changed[odd_count];
    for (int k = 0; k < odd_count; ++k) {
        changed[k] = tokens_of(write(with(parameter, odd[k]).data()));
        if (changed[k].size() != tokens.size()) return {};
    }
    Places places;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const auto offset = offset_from(changed[0][i], odd[0], text.integer);
        int same = 0, fitting = 0;
        for (int k = 0; k < odd_count; ++k) {
            same += changed[k][i] == tokens[i];
            fitting += offset && offset_from(changed[k][i], odd[k], text.integer) == offset;
        }
        if (same == odd_count) continue;
        const std::optional<double> number = number_of(tokens[i]);
        if (fitting != odd_count || !number || !is_value(parameter, *number - *offset)) return {};
        places.tokens.push_back(i);
        places.offsets.push_back(*offset);
    }
    return places;
}

/// Whether the parameter has that value.
bool NamedParameters::is_value(int parameter, double value) const {
    return std::memcmp(with(parameter, value).data(), params_.data(), stage_.params_size) == 0;
}

std::string NamedParameters::written(const Write& write, const Dialect& dialect) const {
    std::vector<std::string> tokens = tokens_of(write(params_.data()));
    const std::vector<std::string> numbers = tokens;
    std::string constants;
    for (int p = 0; p < stage_.parameter_count; ++p) {
        const ParameterText& text = stage_.parameters[p];
        const Places places = places_of(p, numbers, write);
        if (places.tokens.empty()) continue;
        const double value =
            *number_of(numbers[places.tokens[0]]) - static_cast<double>(places.offsets[0]);
        for (std::size_t i = 0; i < places.tokens.size(); ++i) {
            std::string& token = tokens[places.tokens[i]];
            token = expression(names_[static_cast<std::size_t>(p)], places.offsets[i], token,
                               text.integer);
        }
        const std::string number = text.integer ? std::to_string(static_cast<std::int32_t>(value))
                                                : dialect.real(static_cast<float>(value));
        constants += "    " +
                     dialect.parameter(text.integer ? Type::integer : Type::real,
                                       names_[static_cast<std::size_t>(p)], number) +
                     "  // " + text.meaning + "\n";
    }
    std::string function;
    for (const std::string& token : tokens) function += token;
    // Behind the function's head.
    return function.insert(function.find("{\n") + 2, constants);
}

}  // namespace quadrel::recorded
