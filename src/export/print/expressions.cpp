#include "export/print/expressions.hpp"

#include <cmath>

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// How weakly an operator binds.
int level_of_operator(const std::string& text) {
    struct Row {
        const char* text;
        int level;
    };
    static constexpr Row rows[] = {{"*", 3}, {"/", 3}, {"+", 4},  {"-", 4},  {"<<", 5}, {">>", 5},
                                   {"<", 6}, {">", 6}, {"<=", 6}, {">=", 6}, {"==", 7}, {"!=", 7},
                                   {"&", 8}, {"^", 9}, {"|", 10}, {"&&", 11}};
    for (const Row& row : rows)
        if (text == row.text) return row.level;
    return or_level;
}

}  // namespace

int Expressions::level_of(const Node& node) const {
    if (node.kind == Kind::literal) return std::signbit(node.value) ? unary_level : 0;
    if (node.kind == Kind::unary) return unary_level;
    if (node.kind == Kind::select) return dialect_.chooses_by_function() ? 0 : choice_level;
    return node.kind == Kind::binary ? level_of_operator(node.text) : 0;
}

/// A uniform, or whatever else has a name of its own.
std::string Expressions::symbol(const Node& node) const {
    const std::string name = node.text.substr(0, node.text.find('['));
    for (const Uniform& uniform : graph_.uniforms)
        if (uniform.name == name) return dialect_.use_of(uniform, node.text);
    return node.text;
}

std::string Expressions::operands(const Node& node, int level) const {
    const Node &a = *node.arguments[0], &b = *node.arguments[1];
    const auto operand = [&](const Node& of, int within) {
        return text(&of, is_named(&of) ? within : dialect_.operand_level(node, of, within));
    };
    const bool is_shift = node.text == "<<" || node.text == ">>";
    const std::string right = operand(b, level - 1);
    return operand(a, level) + " " + node.text + " " +
           (is_shift ? dialect_.shift_count(b, right) : right);
}

std::string Expressions::text(const Node* node, int within) const {
    const auto name = local_names_.find(node);
    if (name != local_names_.end()) return name->second;
    const int level = level_of(*node);
    const std::string bare_text = bare(*node, level);
    return level > within ? "(" + bare_text + ")" : bare_text;
}

std::string Expressions::literal(const Node& node) const {
    if (node.type == Type::boolean) return node.value != 0 ? "true" : "false";
    if (node.type == Type::integer) return std::to_string(static_cast<std::int32_t>(node.value));
    return dialect_.real(static_cast<float>(node.value));
}

std::string Expressions::name_of(const Variable* variable) const {
    const auto found = variable_names_.find(variable);
    return found != variable_names_.end() ? found->second : "?";
}

std::string Expressions::bare(const Node& node, int level) const {
    const auto& arguments = node.arguments;
    const auto all = [&] {
        std::vector<std::string> texts;
        for (const Node* argument : arguments) texts.push_back(text(argument, choice_level));
        return texts;
    };
    switch (node.kind) {
        case Kind::literal:
            return literal(node);
        case Kind::symbol:
            return symbol(node);
        case Kind::read:
            return name_of(node.variable);
        case Kind::unary:
            return node.text + text(arguments[0], unary_level - 1);
        case Kind::binary:
            return operands(node, level);
        case Kind::select:
            return dialect_.choice(text(arguments[0], or_level), text(arguments[1], or_level),
                                   text(arguments[2], choice_level));
        case Kind::component:
            if (node.index < 0) return dialect_.prefix(text(arguments[0], 0), -node.index);
            return text(arguments[0], 0) + "." + "xyzw"[node.index];
        case Kind::construct: {
            Node named = node;
            named.text = dialect_.type(node.type);
            return dialect_.call(named, all());
        }
        case Kind::call:
            break;
    }
    return dialect_.call(node, all());
}

}  // namespace quadrel::recorded
