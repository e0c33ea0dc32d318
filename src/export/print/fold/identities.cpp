// What an operation is by itself: of constants their value, by the laws that hold for every number,
// -0, infinities and NaN among them, one of its arguments.
#include <climits>
#include <cmath>
#include <utility>

#include "export/print/fold/fold.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

bool is_operation(const Node& node, Kind kind, const char* text) {
    return node.kind == kind && node.text == text;
}

bool compared(const std::string& text, double a, double b) {
    if (text == "<") return a < b;
    if (text == "<=") return a <= b;
    if (text == ">") return a > b;
    if (text == ">=") return a >= b;
    return text == "==" ? a == b : a != b;
}

bool is_comparison(const std::string& text) {
    return text == "<" || text == "<=" || text == ">" || text == ">=" || text == "==" ||
           text == "!=";
}

std::int32_t wrapped(const std::string& text, double a, double b) {
    const auto x = static_cast<std::uint32_t>(static_cast<std::int32_t>(a));
    const auto y = static_cast<std::uint32_t>(static_cast<std::int32_t>(b));
    if (text == "+") return static_cast<std::int32_t>(x + y);
    if (text == "-") return static_cast<std::int32_t>(x - y);
    return static_cast<std::int32_t>(x * y);
}

float computed_real(const std::string& text, double a, double b) {
    const float x = static_cast<float>(a), y = static_cast<float>(b);
    if (text == "+") return x + y;
    if (text == "-") return x - y;
    return text == "*" ? x * y : x / y;
}

/// Whether a sum, square or the like can be no -0, so that 0 + x is x.
bool is_never_minus_zero(const Node& node, int depth = 0) {
    if (node.kind == Kind::literal) return !is_literal(node, -0.0);
    if (depth == 8) return false;
    const auto is_never = [&](std::size_t i) {
        return is_never_minus_zero(*node.arguments[i], depth + 1);
    };
    if (node.kind == Kind::select) return is_never(1) && is_never(2);
    if (node.kind == Kind::call)
        return node.text == "abs" || node.text == "float" || node.text == "exp2" ||
               node.text == "length";
    if (node.kind != Kind::binary) return false;
    if (node.text == "+") return is_never(0) || is_never(1);
    if (node.text == "-") return is_never(0);
    return node.text == "*" && node.arguments[0] == node.arguments[1];
}

}  // namespace

Node* Folder::simple_logic(Node& node) {
    auto& arguments = node.arguments;
    if (node.kind == Kind::binary && (node.text == "&&" || node.text == "||")) {
        const bool is_and = node.text == "&&";
        for (std::size_t i = 0; i < 2; ++i)
            if (arguments[i]->kind == Kind::literal)
                return (arguments[i]->value != 0) == is_and ? arguments[1 - i] : arguments[i];
        if (arguments[0] == arguments[1]) return arguments[0];
    }
    if (!is_operation(node, Kind::unary, "!")) return nullptr;
    const Node& of = *arguments[0];
    if (of.kind == Kind::literal) return literal(Type::boolean, of.value == 0);
    if (is_operation(of, Kind::unary, "!")) return of.arguments[0];
    // These alone are each other's complement where a number is NaN.
    for (const auto& [text, complement] : {std::pair("==", "!="), std::pair("!=", "==")})
        if (is_operation(of, Kind::binary, text)) {
            node.kind = Kind::binary;
            node.text = complement;
            node.arguments = of.arguments;
            return nullptr;
        }
    return nullptr;
}

namespace {

/// Whether `number` is the whole number as a float: float(n), or 2 * float(n) of 2 * n, which
/// rounds alike.
bool is_float_of(const Node& number, const Node& whole) {
    if (is_operation(number, Kind::call, "float")) return number.arguments[0] == &whole;
    return is_operation(number, Kind::binary, "*") && is_operation(whole, Kind::binary, "*") &&
           is_literal(*number.arguments[0], 2) && is_literal(*whole.arguments[0], 2) &&
           is_float_of(*number.arguments[1], *whole.arguments[1]);
}

}  // namespace

/// A loop's counter is not above its last value, which texts ask where other number types go on.
Node* Folder::counted(const Node& node) {
    if (node.kind != Kind::binary || node.text != "<=") return nullptr;
    const Node &counter = *node.arguments[0], &most = *node.arguments[1];
    if (!is_operation(counter, Kind::call, "float")) return nullptr;
    const Node& of = *counter.arguments[0];
    if (of.loop == nullptr) return nullptr;
    const Node* const last = folded_.at(of.loop->last);
    const bool is_last = is_float_of(most, *last);
    const bool is_below = last->kind == Kind::literal && most.kind == Kind::literal &&
                          last->value <= most.value && last->value < 16777216;
    return is_last || is_below ? literal(Type::boolean, 1) : nullptr;
}

/// float(int(float(i))) of a loop's counter is float(i).
Node* Folder::whole_again(const Node& node) {
    if (!is_operation(node, Kind::call, "float")) return nullptr;
    const Node& whole = *node.arguments[0];
    if (!is_operation(whole, Kind::call, "int")) return nullptr;
    Node* const number = whole.arguments[0];
    if (!is_operation(*number, Kind::call, "float")) return nullptr;
    return number->arguments[0]->loop != nullptr ? number : nullptr;
}

/// x - 0, x + -0, x * 1 and x / 1 are x, whatever x is; 0 + x is not where x may be -0.
Node* Folder::simple_sum(const Node& node) {
    if (node.kind != Kind::binary || node.type == Type::boolean) return nullptr;
    Node *const a = node.arguments[0], *const b = node.arguments[1];
    if (node.text == "-" && is_literal(*b, 0)) return a;
    const double nothing = node.type == Type::integer ? 0 : -0.0;
    if (node.text == "+" || (node.text == "|" && node.type == Type::integer)) {
        if (is_literal(*a, nothing)) return b;
        if (is_literal(*b, nothing)) return a;
    }
    if (node.text == "+" && node.type != Type::integer) {
        if (is_literal(*a, 0) && is_never_minus_zero(*b)) return b;
        if (is_literal(*b, 0) && is_never_minus_zero(*a)) return a;
    }
    if (node.text == "*") {
        if (is_literal(*a, 1)) return b;
        if (is_literal(*b, 1)) return a;
    }
    return node.text == "/" && is_literal(*b, 1) ? a : nullptr;
}

/// x + -2 is x - 2.
void Folder::subtract_negative(Node& node) {
    if (!is_operation(node, Kind::binary, "+")) return;
    const Node& b = *node.arguments[1];
    if (b.kind != Kind::literal || !(b.value < 0) || b.value == INT_MIN) return;
    node.text = "-";
    node.arguments[1] = literal(b.type, -b.value);
}

Node* Folder::computed(const Node& node) {
    const auto& arguments = node.arguments;
    for (const Node* argument : arguments)
        if (argument->kind != Kind::literal) return nullptr;
    if (node.kind == Kind::unary && node.text == "-") {
        const double value = arguments[0]->value;
        return literal(node.type, node.type == Type::real ? -value : wrapped("-", 0, value));
    }
    if (is_operation(node, Kind::call, "float"))
        return literal(Type::real, static_cast<float>(arguments[0]->value));
    if (node.kind != Kind::binary) return nullptr;
    const double a = arguments[0]->value, b = arguments[1]->value;
    if (is_comparison(node.text)) return literal(Type::boolean, compared(node.text, a, b));
    if (node.text != "+" && node.text != "-" && node.text != "*" && node.text != "/")
        return nullptr;
    if (node.type == Type::real) return literal(Type::real, computed_real(node.text, a, b));
    return node.text == "/" ? nullptr : literal(Type::integer, wrapped(node.text, a, b));
}

}  // namespace quadrel::recorded
