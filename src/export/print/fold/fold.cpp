#include "export/print/fold/fold.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
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

bool is_difference(const Node& node) {
    static constexpr const char* functions[] = {"dFdx", "dFdy", "dFdxFine", "dFdyFine", "texture"};
    return node.kind == Kind::call &&
           std::any_of(std::begin(functions), std::end(functions),
                       [&](const char* function) { return node.text == function; });
}

namespace {

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

}  // namespace

void Folder::run() {
    for (const auto& node : graph_.nodes) {
        known_masks_.learn_up_to(node->order, folded_);
        folded_[node.get()] = folded(*node);
    }
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
    for (Node*& argument : copy.arguments) argument = argument_of(node, argument);
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

Node* Folder::argument_of(const Node& user, const Node* argument) {
    Node* const result = folded_.at(argument);
    if (result->type == Type::real) return part_of_vector(user, result);
    if (result->type != Type::boolean) return result;
    const std::optional<bool> known = known_masks_.find(result, user.region);
    return known ? literal(Type::boolean, *known ? 1 : 0) : result;
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
    if (Node* const result = simple_choice(node)) return result;
    if (node.kind == Kind::component && arguments[0]->kind == Kind::construct && node.index >= 0) {
        const auto& parts = arguments[0]->arguments;
        return parts[parts.size() == 1 ? 0 : static_cast<std::size_t>(node.index)];
    }
    if (node.kind == Kind::construct && arguments.size() > 1)
        if (Node* const vector = rolled(arguments, node, 0)) {
            add_parts(arguments, vector);
            return named_vector(node, vector);
        }
    return unique(std::move(node));
}

Node* Folder::simple_choice(const Node& node) {
    if (node.kind != Kind::select) return nullptr;
    Node* const condition = node.arguments[0];
    if (condition->kind == Kind::literal) return node.arguments[condition->value != 0 ? 1 : 2];
    if (node.arguments[1] == node.arguments[2]) return node.arguments[1];
    // What the same condition has chosen before.
    Node copy = node;
    for (const std::size_t i : {1, 2})
        if (node.arguments[i]->kind == Kind::select && node.arguments[i]->arguments[0] == condition)
            copy.arguments[i] = node.arguments[i]->arguments[i];
    return copy.arguments == node.arguments ? nullptr : simplified(std::move(copy));
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

}  // namespace quadrel::recorded
