#include "export/print/described.hpp"

#include <limits>
#include <string>
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

/// A name or a small whole number, as a part of a name.
std::string word_of(const Node& node) {
    constexpr double largest = 999;
    if (node.kind == Kind::literal && node.type != Type::boolean) {
        const bool is_word =
            node.value >= 0 && node.value <= largest && node.value == static_cast<int>(node.value);
        return is_word ? std::to_string(static_cast<int>(node.value)) : "";
    }
    std::string name = own_name(node);
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name;
}

/// `a_word_b`, where both have words and these make no long one; else empty.
std::string joined(const Node& a, const std::string& word, const Node& b) {
    static constexpr std::pair<const char*, const char*> numbers[] = {
        {"0", "zero"}, {"1", "one"}, {"2", "two"}, {"3", "three"}, {"4", "four"}};
    constexpr std::size_t longest = 28;
    std::string first = word_of(a);
    if (a.kind == Kind::literal) first = found_in(numbers, first);  // no name begins with a digit
    const std::string second = word_of(b), all = first + "_" + word + "_" + second;
    return first.empty() || second.empty() || all.size() > longest ? "" : all;
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
        {"sqrt", "root"},
        {"roundEven", "rounded"},
        {"ceil", "ceil"},
        {"trunc", "whole"},
        {"fract", "fraction"},
        {"int", "int"},
        {"float", "float"},
        {"isnan", "nan"},
        {"dFdx", "dx"},
        {"dFdy", "dy"},
        {"dFdxFine", "dx"},
        {"dFdyFine", "dy"},
        {"normalize", "unit"},
        {"inversesqrt", "over_root"},
        {"floor", "floor"},
        {"abs", "abs"},
        {"length", "length"},
        {"sign", "sign"},
        {"cos", "cos"},
        {"sin", "sin"},
        {"log2", "log2"},
        {"copysign", "signed"},
        {"exponent", "exponent"},
        {"significand", "significand"},
        {"point_to_eye", "eye"},
        {"vector_to_eye", "eye"},
        {"normal_to_eye", "eye"},
        {"point_to_object", "object"},
        {"vector_to_object", "object"}};
    if (is_clamp(node)) return "clamped";
    if (node.text == "min" || node.text == "max") {
        const std::string both = joined(*node.arguments[0], "and", *node.arguments[1]);
        if (!both.empty()) return node.text + "_of_" + both;
    }
    const std::string word = found_in(words, node.text);
    if (!word.empty()) return word;
    const std::string function = found_in(of_operand, node.text);
    if (!function.empty()) return with_operand(function, *node.arguments[0]);
    const bool is_product = node.text == "dot" || node.text == "cross";
    if (!is_product) return node.text;
    const std::string a = own_name(*node.arguments[0]), b = own_name(*node.arguments[1]);
    return a.empty() || b.empty() ? node.text : node.text + "_" + a + "_" + b;
}

/// x - floor(x)
bool is_rest(const Node& node) {
    const Node& floor = *node.arguments[1];
    return node.text == "-" && floor.kind == Kind::call && floor.text == "floor" &&
           floor.arguments[0] == node.arguments[0];
}

/// The difference that is a factor of a product; null where none is.
const Node* difference_in(const Node& product) {
    if (product.kind != Kind::binary || product.text != "*") return nullptr;
    for (const Node* factor : product.arguments)
        if (factor->kind == Kind::binary && factor->text == "-") return factor;
    return nullptr;
}

/// a + t * (b - a)
bool is_mixture(const Node& node) {
    const Node* const difference = node.text == "+" ? difference_in(*node.arguments[1]) : nullptr;
    return difference != nullptr && difference->arguments[1] == node.arguments[0];
}

/// x, by a period more or less where it is outside.
bool is_wrapped(const Node& choice) {
    const Node &moved = *choice.arguments[1], &same = *choice.arguments[2];
    return choice.type == Type::integer && moved.kind == Kind::binary &&
           (moved.text == "+" || moved.text == "-") && moved.arguments[0] == &same;
}

/// What people call some of them, else the operands' names with the operator's between.
std::string joined_operands(const Node& node, const std::string& between) {
    const Node &a = *node.arguments[0], &b = *node.arguments[1];
    if (between.empty()) return "";
    if (node.text == "*" && &a == &b && !word_of(a).empty()) return word_of(a) + "_squared";
    for (const auto& [number, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        if (node.text != "*" || own_name(*other).empty()) continue;
        if (is_number(*number, 0.5)) return with_operand("half", *other);
        if (is_number(*number, 2)) return with_operand("twice", *other);
    }
    return joined(a, between, b);
}

std::string described_binary(const Node& node) {
    static constexpr std::pair<const char*, const char*> words[] = {
        {"+", "sum"},     {"-", "difference"}, {"*", "product"},  {"/", "ratio"}, {"&&", "both"},
        {"||", "either"}, {"<<", "shifted"},   {">>", "shifted"}, {"&", "bits"},  {"|", "bits"},
        {"^", "bits"},    {"<", "less"},       {"<=", "less"},    {">", "more"},  {">=", "more"},
        {"==", "equal"},  {"!=", "unequal"}};
    static constexpr std::pair<const char*, const char*> to_zero[] = {
        {"<", "negative"}, {">", "positive"}, {"==", "zero"}, {"!=", "nonzero"}};
    static constexpr std::pair<const char*, const char*> between[] = {
        {"+", "plus"},  {"-", "minus"},     {"*", "times"}, {"/", "over"},
        {"&&", "and"},  {"||", "or"},       {"<", "below"}, {"<=", "at_most"},
        {">", "above"}, {">=", "at_least"}, {"==", "is"},   {"!=", "is_not"}};
    const Node &a = *node.arguments[0], &b = *node.arguments[1];
    const bool is_whole = node.type == Type::integer;
    if (is_finite_test(node)) return "finite";
    if (is_rest(node)) return with_operand("fraction", a);
    if (is_mixture(node)) {
        const std::string ends = joined(a, "to", *difference_in(b)->arguments[0]);
        return ends.empty() ? "mixed" : ends;
    }
    if (is_whole && is_number(b, 1) && node.text == "+" && !own_name(a).empty())
        return with_operand("after", a);
    if (is_whole && is_number(b, 1) && node.text == "-" && !own_name(a).empty())
        return with_operand("before", a);
    const std::string sign = is_number(b, 0) ? found_in(to_zero, node.text) : "";
    if (!sign.empty()) return with_operand(sign, a);
    const std::string named = joined_operands(node, found_in(between, node.text));
    return named.empty() ? found_in(words, node.text) : named;
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
        case Kind::select: {
            if (is_wrapped(node)) return with_operand("wrapped", *node.arguments[2]);
            const std::string either = joined(*node.arguments[1], "or", *node.arguments[2]);
            return either.empty() ? "chosen" : either;
        }
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
