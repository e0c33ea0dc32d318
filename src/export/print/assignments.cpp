#include "export/print/assignments.hpp"

#include <algorithm>

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// Whether the text of `node` reads the variable.
bool touches(const Node* node, const Variable* variable, const Expressions& expressions) {
    if (expressions.is_named(node) || node->kind == Kind::read)
        return expressions.text(node, choice_level) == expressions.name_of(variable);
    return std::any_of(node->arguments.begin(), node->arguments.end(), [&](const Node* argument) {
        return touches(argument, variable, expressions);
    });
}

/// `" += x"` of a value that is the old one and x more, and so on; else empty.
template <class IsOld>
std::string change_of(const Node& value, const IsOld& is_old, const Expressions& expressions) {
    if (expressions.is_named(&value) || value.kind != Kind::binary || !is_old(value.arguments[0]))
        return "";
    for (const char* text : {"+", "-", "*", "/", "|"})
        if (value.text == text)
            return std::string(" ") + text + "= " +
                   expressions.text(value.arguments[1], choice_level);
    return "";
}

}  // namespace

std::vector<AssignmentGroup> groups_of(const Event& event, const Expressions& expressions) {
    std::vector<AssignmentGroup> groups;
    for (const Assignment& of : event.assignments) {
        const Node& value = *of.value;
        const std::string name = expressions.name_of(of.variable);
        const auto is_old = [&](const Node* node) {
            return (node->kind == Kind::read || expressions.is_named(node)) &&
                   expressions.text(node, choice_level) == name;
        };
        const bool is_open = !expressions.is_named(&value);
        const Node* condition = nullptr;
        std::string assigned;
        if (is_open && value.kind == Kind::select && is_old(value.arguments[2])) {
            condition = value.arguments[0];
            assigned = expressions.text(value.arguments[1], choice_level);
        } else if (is_open && value.kind == Kind::binary && value.text == "||" &&
                   is_old(value.arguments[0])) {
            condition = value.arguments[1];
            assigned = "true";
        } else {
            assigned = expressions.text(&value, choice_level);
            if (assigned == name) continue;
        }
        if (groups.empty() || groups.back().condition != condition)
            groups.push_back({condition, {}});
        const Node& of_old = condition == nullptr ? value : *value.arguments[1];
        const std::string by = condition == nullptr || value.kind == Kind::select
                                   ? change_of(of_old, is_old, expressions)
                                   : "";
        groups.back().lines.push_back(name + (by.empty() ? " = " + assigned : by) + ";");
    }
    return groups;
}

bool are_independent(const Event& event, const Expressions& expressions) {
    for (const Assignment& a : event.assignments)
        for (const Assignment& b : event.assignments)
            if (&a != &b && touches(a.value, b.variable, expressions)) return false;
    return true;
}

namespace {

bool is_negation_of(const Node* a, const Node* b) {
    return a != nullptr && a->kind == Kind::unary && a->text == "!" && a->arguments[0] == b;
}

}  // namespace

void pair_groups(std::vector<AssignmentGroup>& groups) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto first = groups.begin() + static_cast<std::ptrdiff_t>(i);
        const auto other = std::find_if(first + 1, groups.end(), [&](const AssignmentGroup& of) {
            return is_negation_of(of.condition, first->condition) ||
                   is_negation_of(first->condition, of.condition);
        });
        if (first->condition == nullptr || other == groups.end()) continue;
        std::rotate(first + 1, other, other + 1);
        if (is_negation_of(first->condition, first[1].condition)) std::iter_swap(first, first + 1);
        ++i;
    }
}

void join_groups(std::vector<AssignmentGroup>& groups) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        for (std::size_t j = i + 1; j < groups.size();) {
            if (groups[j].condition != groups[i].condition) {
                ++j;
                continue;
            }
            groups[i].lines.insert(groups[i].lines.end(), groups[j].lines.begin(),
                                   groups[j].lines.end());
            groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(j));
        }
    }
}

bool leaves_by_group(std::vector<AssignmentGroup>& groups, const Event& leave, const Locals& locals,
                     const Expressions& expressions) {
    const Node* const stay = leave.value;
    if (locals.condition_of(&leave) != nullptr || stay->kind != Kind::unary || stay->text != "!" ||
        expressions.is_named(stay))
        return false;
    const auto found = std::find_if(
        groups.begin(), groups.end(),
        [&](const AssignmentGroup& group) { return group.condition == stay->arguments[0]; });
    if (found == groups.end()) return false;
    found->lines.emplace_back("break;");
    std::rotate(found, found + 1, groups.end());
    return true;
}

}  // namespace quadrel::recorded
