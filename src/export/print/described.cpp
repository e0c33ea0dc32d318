#include "export/print/described.hpp"

#include <limits>
#include <utility>

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

template <std::size_t n>
std::string found_in(const std::pair<const char*, const char*> (&words)[n],
                     const std::string& text) {
    for (const auto& [known, word] : words)
        if (text == known) return word;
    return "";
}

/// `word` and what it is said of, where that has a name.
std::string with_operand(const std::string& word, const Node& operand) {
    const std::string of = own_name(operand);
    return of.empty() ? word : word + "_" + of;
}

bool is_number(const Node& node, double value) {
    return node.kind == Kind::literal && node.value == value;
}

/// abs(x) <= the largest number, or several of these.
bool is_finite_test(const Node& node) {
    if (node.kind != Kind::binary) return false;
    const Node &a = *node.arguments[0], &b = *node.arguments[1];
    if (node.text == "&&") return is_finite_test(a) && is_finite_test(b);
    return node.text == "<=" && a.kind == Kind::call && a.text == "abs" &&
           is_number(b, double{std::numeric_limits<float>::max()});
}

bool is_clamp(const Node& node) {
    if (node.text != "min" || node.arguments[1]->kind != Kind::literal) return false;
    const Node& inner = *node.arguments[0];
    return inner.kind == Kind::call && inner.text == "max" &&
           inner.arguments[1]->kind == Kind::literal;
}

std::string described_call(const Node& node) {
    static constexpr std::pair<const char*, const char*> words[] = {
        {"texture", "texel"},      {"textureLod", "texel"}, {"textureGrad", "texel"},
        {"textureLayer", "texel"}, {"texelFetch", "texel"}, {"textureGather", "texels"},
        {"texelLayer", "texel"},   {"textureSize", "size"}, {"min", "least"},
        {"max", "most"},           {"clamp", "clamped"},    {"mix", "mixed"},
        {"mod", "rest"},           {"pow", "power"},        {"exp", "exponential"},
        {"exp2", "exponential"}};
    static constexpr std::pair<const char*, const char*> of_operand[] = {
        {"sqrt", "root"},         {"roundEven", "rounded"},
        {"ceil", "ceil"},         {"trunc", "whole"},
        {"fract", "fraction"},    {"int", "int"},
        {"float", "float"},       {"isnan", "nan"},
        {"dFdx", "dx"},           {"dFdy", "dy"},
        {"dFdxFine", "dx"},       {"dFdyFine", "dy"},
        {"normalize", "unit"},    {"inversesqrt", "over_root"},
        {"floor", "floor"},       {"abs", "abs"},
        {"length", "length"},     {"sign", "sign"},
        {"cos", "cos"},           {"sin", "sin"},
        {"log2", "log2"},         {"copysign", "signed"},
        {"exponent", "exponent"}, {"significand", "significand"}};
    if (is_clamp(node)) return "clamped";
    const std::string word = found_in(words, node.text);
    if (!word.empty()) return word;
    const std::string function = found_in(of_operand, node.text);
    if (!function.empty()) return with_operand(function, *node.arguments[0]);
    const bool is_product = node.text == "dot" || node.text == "cross";
    if (!is_product) return node.text;
    const std::string a = own_name(*node.arguments[0]), b = own_name(*node.arguments[1]);
    return a.empty() || b.empty() ? node.text : node.text + "_" + a + "_" + b;
}

std::string described_binary(const Node& node) {
    static constexpr std::pair<const char*, const char*> words[] = {
        {"+", "sum"},     {"-", "difference"}, {"*", "product"},  {"/", "ratio"}, {"&&", "both"},
        {"||", "either"}, {"<<", "shifted"},   {">>", "shifted"}, {"&", "bits"},  {"|", "bits"},
        {"^", "bits"},    {"<", "less"},       {"<=", "less"},    {">", "more"},  {">=", "more"},
        {"==", "equal"},  {"!=", "unequal"}};
    static constexpr std::pair<const char*, const char*> to_zero[] = {
        {"<", "negative"}, {">", "positive"}, {"==", "zero"}, {"!=", "nonzero"}};
    const Node &a = *node.arguments[0], &b = *node.arguments[1];
    const bool is_whole = node.type == Type::integer;
    if (is_finite_test(node)) return "finite";
    if (is_whole && is_number(b, 1) && node.text == "+" && !own_name(a).empty())
        return with_operand("after", a);
    if (is_whole && is_number(b, 1) && node.text == "-" && !own_name(a).empty())
        return with_operand("before", a);
    const std::string sign = is_number(b, 0) ? found_in(to_zero, node.text) : "";
    return sign.empty() ? found_in(words, node.text) : with_operand(sign, a);
}

}  // namespace

std::string own_name(const Node& node) {
    if (node.kind == Kind::symbol) return node.text.substr(0, node.text.find('['));
    if (node.kind == Kind::read) {
        std::string name;
        for (const std::string& of : node.variable->names)
            if (!of.empty()) name = of;
        return name;
    }
    if (!node.name.empty()) return node.name;
    if (!node.weak_name.empty() || node.kind != Kind::component) return node.weak_name;
    const std::string vector = own_name(*node.arguments[0]);
    if (vector.empty() || node.index < 0) return vector;
    return vector + "_" + "xyzw"[node.index];
}

std::string described(const Node& node) {
    switch (node.kind) {
        case Kind::call:
            return described_call(node);
        case Kind::binary:
            return described_binary(node);
        case Kind::unary:
            return with_operand(node.text == "!" ? "not" : "minus", *node.arguments[0]);
        case Kind::select:
            return "chosen";
        case Kind::construct:
            return "vector";
        case Kind::component:
            return node.arguments[0]->kind == Kind::call ? described(*node.arguments[0])
                                                         : own_name(node);
        case Kind::literal:
        case Kind::symbol:
        case Kind::read:
            break;
    }
    return own_name(node);
}

}  // namespace quadrel::recorded
