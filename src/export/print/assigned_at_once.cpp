// Values that a variable holds as soon as they are computed. A recording changes variables at the
// ends of rounds and of blocks alone, and what texts compute on the way would be locals: values
// that are assigned later, and steps of the same name towards them. Where nobody can tell, these
// are the variable.
#include <algorithm>
#include <limits>

#include "export/print/described.hpp"
#include "export/print/fold/fold.hpp"
#include "export/print/locals.hpp"
#include "export/print/names.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

constexpr int never = std::numeric_limits<int>::max();

std::string name_of(const Variable& variable) {
    std::string name;
    for (const std::string& of : variable.names)
        if (!of.empty()) name = of;
    return local_name(name);
}

/// Whether the loop or block may be left, or gone on with, at an event in between.
bool is_left_between(const Region& region, int from, int to) {
    return std::any_of(region.events.begin(), region.events.end(), [&](const Event& of) {
        return of.kind == Event::Kind::leave && of.order > from && of.order < to;
    });
}

}  // namespace

void Locals::assign_at_once(Region& region) {
    for (Event& event : region.events) {
        if (event.kind == Event::Kind::assign) assign_values(region, event);
        if (event.kind != Event::Kind::loop) continue;
        assign_at_once(event.loop->body);
        for (const auto& variable : event.loop->variables)
            if (is_needed(variable.get()) && named_as(variable.get()) == nullptr)
                assign_steps(region, {variable.get(), nullptr, never, never}, event.order, never);
    }
}

/// Takes assignments out of the event whose values are their variables' own from the start.
void Locals::assign_values(const Region& region, Event& event) {
    std::erase_if(event.assignments, [&](const Assignment& of) {
        const int before = of.variable->version_order[static_cast<std::size_t>(of.version) - 1];
        const bool is_own = of.value->order > before &&
                            last_use_of(of.value) <= next_change(region, event, of) &&
                            may_hold(region, of, of.value, event.order);
        if (is_own) at_once_.emplace(of.value, of);
        assign_steps(region, of, before, event.order);
        return is_own;
    });
}

/// What has the variable's name on the way to its version, between two events.
void Locals::assign_steps(const Region& region, const Assignment& to, int from, int event) {
    const std::string name = name_of(*to.variable);
    const bool is_at_once = to.value != nullptr && at_once_.count(to.value) != 0;
    const int end = is_at_once ? to.value->order : to.order;
    for (const auto& node : graph_.nodes)
        if (node->order > from && node->order < end && node->type == to.variable->type &&
            !name.empty() && local_name(own_name(*node)) == name &&
            last_use_of(node.get()) <= end && may_hold(region, to, node.get(), event))
            at_once_.emplace(node.get(),
                             Assignment{to.variable, node.get(), to.version, node->order});
}

/// Whether nobody can tell before the event that the variable holds `value` from where that is
/// computed: it is not left with the old one, nor is that read, nor what it held at once before.
bool Locals::may_hold(const Region& region, const Assignment& to, const Node* value,
                      int event) const {
    if (value->region != &region || !is_declared(value) || is_leaf(*value) ||
        at_once_.count(value) != 0 || is_left_between(region, value->order, event))
        return false;
    const Variable* const variable = to.variable;
    for (const auto& [other, of] : at_once_)
        if (has_same_name(of.variable, variable) && other->region == &region &&
            last_use_of(other) > value->order)
            return false;
    const auto reads_old = [&](const Node* node) { return reads_older(node, to, event); };
    for (const Root& root : roots_)
        if (root.order > value->order && reads_old(root.node)) return false;
    return std::none_of(graph_.nodes.begin(), graph_.nodes.end(), [&](const auto& node) {
        return node.get() != value && node->order >= value->order && is_needed(node.get()) &&
               is_declared(node.get()) &&
               std::any_of(node->arguments.begin(), node->arguments.end(), reads_old);
    });
}

/// Whether the text of an expression reads what the variable held before `to`, under its name.
bool Locals::reads_older(const Node* node, const Assignment& to, int event) const {
    if (is_declared(node)) return false;
    if (node->kind == Kind::read && has_same_name(node->variable, to.variable)) {
        if (node->variable == to.variable) return node->index < to.version;
        // A variable around it that it goes on from, else one of another loop or block.
        for (const Variable* inner = to.variable; inner != nullptr; inner = named_as(inner))
            if (named_as(inner) == node->variable) return node->index <= inner->initial->index;
        return begin_.at(node->variable) < event;
    }
    return std::any_of(node->arguments.begin(), node->arguments.end(),
                       [&](const Node* argument) { return reads_older(argument, to, event); });
}

/// When the variable, or what has its name, changes after the event.
int Locals::next_change(const Region& region, const Event& event, const Assignment& of) const {
    const auto next = static_cast<std::size_t>(of.version) + 1;
    const auto& versions = of.variable->version_order;
    int change = next < versions.size() ? versions[next] : never;
    for (const Event& other : region.events) {
        if (other.kind != Event::Kind::loop || other.order < event.order) continue;
        for (const auto& inner : other.loop->variables)
            if (is_needed(inner.get()) && has_same_name(inner.get(), of.variable))
                change = std::min(change, other.order);
    }
    return change;
}

bool Locals::has_same_name(const Variable* a, const Variable* b) const {
    while (named_as(a) != nullptr) a = named_as(a);
    while (named_as(b) != nullptr) b = named_as(b);
    return a == b;
}

/// When the last statement comes whose text names the node.
int Locals::last_use_of(const Node* node) const {
    int last = node->order;
    for (const Use& use : find(node).uses) {
        const bool is_part = use.node != nullptr && !is_declared(use.node);
        last = std::max(last, is_part               ? last_use_of(use.node)
                              : use.node != nullptr ? use.node->order
                                                    : use.order);
    }
    return last;
}

}  // namespace quadrel::recorded
