#include "export/print/fold.hpp"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <utility>

namespace quadrel::recorded {

using Kind = Node::Kind;

bool is_within(const Region* outer, const Region* inner) {
    for (; inner != nullptr; inner = inner->parent)
        if (inner == outer) return true;
    return false;
}

bool is_leaf(const Node& node) {
    return node.kind == Kind::literal || node.kind == Kind::symbol || node.kind == Kind::read;
}

bool is_literal(const Node& node, double value) {
    return node.kind == Kind::literal && node.value == value &&
           std::signbit(node.value) == std::signbit(value);
}

namespace {

bool is_operation(const Node& node, Kind kind, const char* text) {
    return node.kind == kind && node.text == text;
}

/// What tells nodes apart.
std::string key_of(const Node& node) {
    std::string key = std::to_string(static_cast<int>(node.kind)) + '|' +
                      std::to_string(static_cast<int>(node.type)) + '|' + node.text + '|' +
                      std::to_string(node.index) + '|';
    char part[64];
    std::snprintf(part, sizeof part, "%a", node.value);
    key += part;
    for (const void* of :
         {static_cast<const void*>(node.variable), static_cast<const void*>(node.loop)}) {
        std::snprintf(part, sizeof part, "|%p", of);
        key += part;
    }
    for (const Node* argument : node.arguments) {
        std::snprintf(part, sizeof part, "|%p", static_cast<const void*>(argument));
        key += part;
    }
    return key;
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

/// What GLSL has for vectors, too, component by component.
bool is_componentwise(const std::string& function) {
    static const char* const functions[] = {
        "sqrt",        "abs",   "floor", "ceil", "trunc", "roundEven", "fract", "sign",
        "inversesqrt", "exp2",  "exp",   "log2", "log",   "min",       "max",   "mod",
        "pow",         "clamp", "mix",   "step", "dFdx",  "dFdy"};
    for (const char* known : functions)
        if (function == known) return true;
    return false;
}

/// Where a number for all components stays one beside vectors.
bool takes_a_number(const Node& operation, std::size_t argument) {
    if (operation.kind == Kind::binary) return true;
    if (operation.kind == Kind::select) return argument == 0;
    if (operation.text == "mix") return argument == 2;
    const bool is_either =
        operation.text == "min" || operation.text == "max" || operation.text == "mod";
    return is_either && argument == 1;
}

}  // namespace

void Folder::run() {
    for (const auto& node : graph_.nodes) folded_[node.get()] = folded(*node);
    for (const auto& loop : graph_.loops) {
        for (Node** of : {&loop->condition, &loop->first, &loop->last})
            if (*of != nullptr) *of = folded_.at(*of);
        for (const auto& variable : loop->variables)
            variable->initial = folded_.at(variable->initial);
    }
    rename(graph_.top);
    graph_.nodes = std::move(kept_);
}

void Folder::rename(Region& region) {
    for (Event& event : region.events) {
        if (event.value != nullptr) event.value = folded_.at(event.value);
        for (Assignment& assignment : event.assignments)
            assignment.value = folded_.at(assignment.value);
        if (event.kind == Event::Kind::loop) rename(event.loop->body);
    }
}

Node* Folder::folded(const Node& node) {
    if (node.kind == Kind::read) return folded_read(node);
    Node copy = node;
    for (Node*& argument : copy.arguments) argument = folded_.at(argument);
    Node* const result = simplified(std::move(copy));
    if (!is_leaf(*result)) {
        if (result->name.empty() && result->region == node.region && !node.name.empty()) {
            result->name = node.name;
            result->comments = node.comments;
        }
        if (result->weak_name.empty()) result->weak_name = node.weak_name;
    }
    return result;
}

Node* Folder::folded_read(const Node& read) {
    const Variable& variable = *read.variable;
    if (read.is_true || (read.index == 0 && variable.guards)) return literal(Type::boolean, 1);
    if (variable.version_order.size() == 1) return folded_.at(variable.initial);
    return unique(read);
}

Node* Folder::literal(Type type, double value) {
    Node node;
    node.type = type;
    node.value = value;
    return unique(std::move(node));
}

Node* Folder::unique(Node node) {
    const bool is_anywhere = node.kind == Kind::literal || node.kind == Kind::symbol;
    if (is_anywhere) {
        node.region = &graph_.top;
        node.name.clear();
        node.weak_name.clear();
    }
    std::vector<Node*>& known = equal_[key_of(node)];
    for (Node* other : known) {
        if (!is_anywhere && !is_within(other->region, node.region)) continue;
        if (other->name.empty() && !is_leaf(*other)) {
            other->name = node.name;
            other->comments = node.comments;
        }
        if (other->weak_name.empty()) other->weak_name = node.weak_name;
        return other;
    }
    kept_.push_back(std::make_unique<Node>(std::move(node)));
    known.push_back(kept_.back().get());
    return kept_.back().get();
}

Node* Folder::simplified(Node node) {
    if (Node* const result = simple_logic(node)) return result;
    if (Node* const result = simple_sum(node)) return result;
    if (Node* const result = computed(node)) return result;
    if (Node* const result = counted(node)) return result;
    if (Node* const result = whole_again(node)) return result;
    subtract_negative(node);
    const auto& arguments = node.arguments;
    if (node.kind == Kind::select) {
        if (arguments[0]->kind == Kind::literal)
            return arguments[0]->value != 0 ? arguments[1] : arguments[2];
        if (arguments[1] == arguments[2]) return arguments[1];
    }
    if (node.kind == Kind::component && arguments[0]->kind == Kind::construct && node.index >= 0) {
        const auto& parts = arguments[0]->arguments;
        return parts[parts.size() == 1 ? 0 : static_cast<std::size_t>(node.index)];
    }
    if (node.kind == Kind::construct && arguments.size() > 1)
        if (Node* const vector = rolled(arguments, node, 0)) return named_vector(node, vector);
    return unique(std::move(node));
}

/// A vector that stands for one that the text named.
Node* Folder::named_vector(const Node& node, Node* vector) {
    if (is_leaf(*vector)) return vector;
    if (vector->weak_name.empty()) vector->weak_name = node.weak_name;
    if (vector->name.empty()) {
        vector->name = node.name;
        vector->comments = node.comments;
    }
    return vector;
}

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

/// A loop's counter is not above its last value, which texts ask where other number types go on.
Node* Folder::counted(const Node& node) {
    if (node.kind != Kind::binary || node.text != "<=") return nullptr;
    const Node &counter = *node.arguments[0], &most = *node.arguments[1];
    if (!is_operation(counter, Kind::call, "float")) return nullptr;
    const Node& of = *counter.arguments[0];
    if (of.loop == nullptr) return nullptr;
    const Node* const last = folded_.at(of.loop->last);
    const bool is_last = is_operation(most, Kind::call, "float") && most.arguments[0] == last;
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

// ---- Vectors ------------------------------------------------------------------------------------

Node* Folder::construct(Type type, const std::vector<Node*>& components, const Node& at) {
    Node node;
    node.kind = Kind::construct;
    node.type = type;
    node.arguments = components;
    node.region = at.region;
    node.order = at.order;
    return unique(std::move(node));
}

Node* Folder::rolled(const std::vector<Node*>& components, const Node& at, int depth) {
    bool leaves = true;
    for (const Node* of : components)
        leaves = leaves && (is_leaf(*of) || of->kind == Kind::component);
    const bool same = std::all_of(components.begin(), components.end(),
                                  [&](const Node* of) { return of == components[0]; });
    if (leaves || same) return rolled_leaves(components, at, depth);
    return rolled_operation(components, at, depth);
}

Node* Folder::rolled_leaves(const std::vector<Node*>& components, const Node& at, int depth) {
    const int n = static_cast<int>(components.size());
    const Type type = vector_of(n);
    bool is_prefix = components[0]->kind == Kind::component;
    for (int i = 0; i < n && is_prefix; ++i) {
        const Node& of = *components[static_cast<std::size_t>(i)];
        is_prefix = of.kind == Kind::component && of.index == i &&
                    of.arguments[0] == components[0]->arguments[0];
    }
    if (is_prefix) {
        Node* const vector = components[0]->arguments[0];
        if (vector->type == type) return vector;
        Node node;
        node.kind = Kind::component;
        node.type = type;
        node.index = -n;
        node.arguments = {vector};
        node.region = at.region;
        node.order = at.order;
        return unique(std::move(node));
    }
    if (std::all_of(components.begin(), components.end(),
                    [&](const Node* of) { return of == components[0]; }))
        return construct(type, {components[0]}, at);
    return depth > 0 ? construct(type, components, at) : nullptr;
}

Node* Folder::rolled_operation(const std::vector<Node*>& components, const Node& at, int depth) {
    const Node& first = *components[0];
    const Type type = vector_of(static_cast<int>(components.size()));
    for (const Node* of : components)
        if (of->kind != first.kind || of->text != first.text || of->type != first.type ||
            of->arguments.size() != first.arguments.size() || !of->name.empty())
            return nullptr;
    const bool is_call = first.kind == Kind::call;
    if (is_call && !is_componentwise(first.text))
        return depth > 0 ? construct(type, components, at) : nullptr;
    if (!is_call && first.kind != Kind::unary && first.kind != Kind::binary &&
        first.kind != Kind::select)
        return nullptr;
    Node node = first;
    bool has_vector = false;
    for (std::size_t j = 0; j < node.arguments.size(); ++j) {
        std::vector<Node*> of_argument;
        bool is_one = true;
        for (const Node* of : components) {
            of_argument.push_back(of->arguments[j]);
            is_one = is_one && of->arguments[j] == first.arguments[j];
        }
        if (is_one && takes_a_number(first, j)) continue;
        if (first.kind == Kind::select && j == 0) return nullptr;
        node.arguments[j] = rolled(of_argument, at, depth + 1);
        if (node.arguments[j] == nullptr) return nullptr;
        has_vector = true;
    }
    if (!has_vector) return nullptr;
    node.type = type;
    node.region = at.region;
    node.order = at.order;
    return simplified(std::move(node));
}

}  // namespace quadrel::recorded
