// Scalars that do the same, as one operation on a vector.
#include <algorithm>

#include "export/print/fold/fold.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// What GLSL has for vectors, too, component by component.
bool is_componentwise(const std::string& function) {
    static const char* const functions[] = {
        "sqrt",        "abs",   "floor", "ceil", "trunc", "roundEven", "fract",    "sign",
        "inversesqrt", "exp2",  "exp",   "log2", "log",   "min",       "max",      "mod",
        "pow",         "clamp", "mix",   "step", "dFdx",  "dFdy",      "dFdxFine", "dFdyFine"};
    for (const char* known : functions)
        if (function == known) return true;
    return false;
}

/// Where a number for all components stays one beside vectors.
bool takes_a_number(const Node& operation, std::size_t argument) {
    if (operation.kind == Kind::binary) return true;
    if (operation.text == "mix") return argument == 2;
    const bool is_either =
        operation.text == "min" || operation.text == "max" || operation.text == "mod";
    return is_either && argument == 1;
}

}  // namespace

Node* Folder::construct(Type type, const std::vector<Node*>& components, const Node& at) {
    Node node;
    node.kind = Kind::construct;
    node.type = type;
    node.arguments = components;
    node.region = at.region;
    node.order = at.order;
    return unique(std::move(node));
}

/// The numbers are parts of the vector from now on.
void Folder::add_parts(const std::vector<Node*>& numbers, Node* vector) {
    if (vector == nullptr || is_leaf(*vector) || vector->kind == Kind::construct) return;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!is_leaf(*numbers[i]) && numbers[i]->kind != Kind::component)
            parts_.emplace(numbers[i], Part{vector, static_cast<int>(i)});
}

/// A number as the component of the vector that is computed anyway, where there is one.
Node* Folder::part_of_vector(const Node& user, Node* number) {
    const auto found = parts_.find(number);
    if (user.kind == Kind::construct || found == parts_.end() ||
        !is_within(found->second.vector->region, user.region))
        return number;
    Node node;
    node.kind = Kind::component;
    node.index = found->second.index;
    node.arguments = {found->second.vector};
    node.region = user.region;
    node.order = user.order;
    return simplified(std::move(node));
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
    if (first.kind == Kind::select) return rolled_choice(components, at, depth);
    if (!is_call && first.kind != Kind::unary && first.kind != Kind::binary) return nullptr;
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

/// One choice for all components, where those of one side at least are a vector's.
Node* Folder::rolled_choice(const std::vector<Node*>& components, const Node& at, int depth) {
    Node node = *components[0];
    bool has_vector = false;
    std::vector<Node*> sides[2];
    for (const Node* of : components) {
        if (of->arguments[0] != node.arguments[0]) return nullptr;
        for (const std::size_t i : {0, 1}) sides[i].push_back(of->arguments[i + 1]);
    }
    for (const std::size_t i : {0, 1}) {
        node.arguments[i + 1] = rolled(sides[i], at, depth + 1);
        has_vector = has_vector || node.arguments[i + 1] != nullptr;
        add_parts(sides[i], node.arguments[i + 1]);
    }
    if (!has_vector) return nullptr;
    node.type = vector_of(static_cast<int>(components.size()));
    for (const std::size_t i : {0, 1})
        if (node.arguments[i + 1] == nullptr)
            node.arguments[i + 1] = construct(node.type, sides[i], at);
    node.region = at.region;
    node.order = at.order;
    return simplified(std::move(node));
}

}  // namespace quadrel::recorded
