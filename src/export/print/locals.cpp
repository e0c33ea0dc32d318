#include "export/print/locals.hpp"

#include <algorithm>

#include "export/print/fold/fold.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

namespace {

/// What costs nothing to say twice.
bool is_cheap(const Node& node) {
    if (is_leaf(node) || node.kind == Kind::component) return true;
    if (node.kind == Kind::unary) return node.name.empty() && is_cheap(*node.arguments[0]);
    // The number of a step, or a parameter, as a float.
    if (node.kind == Kind::call && node.text == "float")
        return node.name.empty() && node.arguments[0]->kind == Kind::symbol;
    return node.kind == Kind::construct &&
           std::all_of(node.arguments.begin(), node.arguments.end(),
                       [](const Node* argument) { return is_leaf(*argument); });
}

/// When the version after the one that is read begins; -1 where there is none.
int end_of(const Node& read) {
    const auto& order = read.variable->version_order;
    const auto next = static_cast<std::size_t>(read.index) + 1;
    return next < order.size() ? order[next] : -1;
}

}  // namespace

Locals::Locals(Graph& graph, const std::set<std::string>& wanted)
    : graph_(graph), needs_(graph, wanted) {
    collect_roots(graph.top);
    count_uses();
    declare();
}

const Locals::Info& Locals::find(const Node* node) const {
    static const Info nothing;
    const auto found = info_.find(node);
    return found != info_.end() ? found->second : nothing;
}

Variable* Locals::named_as(const Variable* variable) const {
    const auto found = named_as_.find(variable);
    return found != named_as_.end() ? found->second : nullptr;
}

Variable* Locals::condition_of(const Event* leave) const {
    const auto found = conditions_.find(leave);
    return found != conditions_.end() ? found->second : nullptr;
}

const Assignment* Locals::assignment_of(const Node* node) const {
    const auto found = at_once_.find(node);
    return found != at_once_.end() ? &found->second : nullptr;
}

// ---- What refers to what ------------------------------------------------------------------------

void Locals::collect_roots(Region& region) {
    for (std::size_t i = 0; i < region.events.size(); ++i) {
        Event& event = region.events[i];
        switch (event.kind) {
            case Event::Kind::store:
                roots_.push_back({event.value, event.order, &region, true});
                break;
            case Event::Kind::leave:
                // The assignments just before.
                for (const Assignment& of : region.events[i - 1].assignments)
                    if (is_needed(of.variable) && of.value == event.value)
                        conditions_[&event] = of.variable;
                if (condition_of(&event) == nullptr)
                    roots_.push_back({event.value, event.order, &region, false});
                break;
            case Event::Kind::assign:
                order_assignments(event);
                for (const Assignment& of : event.assignments)
                    roots_.push_back({of.value, of.order, &region, true});
                break;
            case Event::Kind::loop:
                for (Node* of : {event.loop->condition, event.loop->first, event.loop->last})
                    if (of != nullptr) roots_.push_back({of, event.order, &region, false});
                for (const auto& of : event.loop->variables)
                    if (is_needed(of.get()) || (of->guards && event.loop->condition == nullptr))
                        roots_.push_back({of->initial, event.order, &region,
                                          !of->guards && of->initial->comments.empty()});
                collect_roots(event.loop->body);
                break;
        }
    }
}

const std::set<const Variable*>& Locals::reads_of(const Node* node) {
    const auto found = reads_.find(node);
    if (found != reads_.end()) return found->second;
    std::set<const Variable*> reads;
    if (node->kind == Kind::read) reads.insert(node->variable);
    for (const Node* argument : node->arguments) {
        const std::set<const Variable*>& of = reads_of(argument);
        reads.insert(of.begin(), of.end());
    }
    return reads_[node] = std::move(reads);
}

/// So that, where possible, none reads what one before it has changed. Unneeded ones are dropped.
void Locals::order_assignments(Event& event) {
    std::vector<Assignment> rest, done;
    for (const Assignment& of : event.assignments)
        if (is_needed(of.variable)) rest.push_back(of);
    std::vector<int> orders;
    for (const Assignment& of : rest) orders.push_back(of.order);
    const auto is_free = [&](const Assignment& of) {
        return std::none_of(rest.begin(), rest.end(), [&](const Assignment& other) {
            return other.variable != of.variable && reads_of(other.value).count(of.variable) != 0;
        });
    };
    while (!rest.empty()) {
        auto next = std::find_if(rest.begin(), rest.end(), is_free);
        if (next == rest.end()) next = rest.begin();
        done.push_back(*next);
        rest.erase(next);
    }
    for (std::size_t i = 0; i < done.size(); ++i) {
        done[i].order = orders[i];
        done[i].variable->version_order[static_cast<std::size_t>(done[i].version)] = orders[i];
    }
    event.assignments = std::move(done);
}

void Locals::count_uses() {
    for (const Root& root : roots_)
        info_[root.node].uses.push_back({nullptr, root.order, root.region});
    for (const auto& node : graph_.nodes)
        if (is_needed(node.get()))
            for (const Node* argument : node->arguments)
                info_[argument].uses.push_back({node.get(), node->order, node->region});
}

// ---- What is a local ----------------------------------------------------------------------------

void Locals::declare() {
    std::set<const Node*> assigned;
    for (const Root& root : roots_)
        if (root.is_assigned && uses_of(root.node) == 1) assigned.insert(root.node);
    for (auto node = graph_.nodes.rbegin(); node != graph_.nodes.rend(); ++node)
        declare_if_used_much(node->get(), assigned);
    declare_vectors();
    continue_variables(graph_.top);
    declare_changed();
    name_variables(graph_.top);
    assign_at_once(graph_.top);
}

/// A difference of neighbours is no part of a condition, or of what one chooses: there, a shader
/// may leave it out for some of them.
bool Locals::declare_difference(Node* node) {
    if (!is_difference(*node)) return false;
    Info& info = info_[node];
    // Stored or assigned as it is.
    if (info.uses.size() == 1 && info.uses[0].node == nullptr &&
        info.uses[0].region == node->region)
        return true;
    const bool has_one_user = info.uses.size() == 1 && info.uses[0].node != nullptr;
    const Node* const user = has_one_user ? info.uses[0].node : nullptr;
    info_[user != nullptr && user->kind == Kind::component ? user : node].declared = true;
    return true;
}

void Locals::declare_if_used_much(Node* node, const std::set<const Node*>& assigned) {
    Info& info = info_[node];
    if (!is_needed(node) || is_cheap(*node)) return;
    if (declare_difference(node)) return;
    const auto& arguments = node->arguments;
    // A negation of what has a name, or is a variable, is said again.
    if (node->kind == Kind::unary && node->text == "!" && arguments[0]->kind != Kind::read &&
        (info.uses.size() < 3 || is_leaf(*arguments[0])) &&
        (is_leaf(*arguments[0]) || !arguments[0]->name.empty() || uses_of(arguments[0]) > 1))
        return;
    const bool has_one_user = info.uses.size() == 1 && info.uses[0].node != nullptr;
    // A look-up whose component alone is used: that is the local.
    if (node->kind == Kind::call && node->name.empty() && has_one_user &&
        info.uses[0].node->kind == Kind::component && uses_of(info.uses[0].node) > 1) {
        info_[info.uses[0].node].declared = true;
        return;
    }
    if (!node->name.empty() && assigned.count(node) == 0) info.declared = true;
    if (info.uses.size() > 1) info.declared = true;
    for (const Use& use : info.uses) {
        if (use.node != nullptr && use.node->kind == Kind::component && node->kind != Kind::call)
            info.declared = true;
        // Where it was made, it is computed; not in a loop that it stands in front of.
        const Region* const place = use.node != nullptr ? place_of(use.node) : use.region;
        if (place != node->region) info.declared = true;
    }
}

/// Vectors of which a component is used more than once.
void Locals::declare_vectors() {
    for (const auto& node : graph_.nodes) {
        if (!is_needed(node.get()) || node->kind != Kind::component) continue;
        if (uses_of(node.get()) > 1 && !is_leaf(*node->arguments[0]) && !is_declared(node.get()))
            info_[node->arguments[0]].declared = true;
    }
}

const Region* Locals::place_of(const Node* node) const {
    const Info& info = find(node);
    if (info.declared || info.uses.empty()) return node->region;
    const Use& use = info.uses[0];
    return use.node != nullptr ? place_of(use.node) : use.region;
}

/// A block's variable that goes on from a loop's, and back into it, is the loop's.
void Locals::continue_variables(Region& region) {
    for (Event& event : region.events) {
        if (event.kind != Event::Kind::loop) continue;
        for (const auto& variable : event.loop->variables) {
            const Node* const initial = variable->initial;
            if (event.loop->condition == nullptr || !is_needed(variable.get()) ||
                initial->kind != Kind::read)
                continue;
            const auto& uses = find(initial).uses;
            if (std::any_of(uses.begin(), uses.end(),
                            [&](const Use& use) { return use.order > event.order; }))
                continue;
            continued_[variable.get()] = initial->variable;
            const int end = end_of(*initial);
            if (end >= 0) variable->version_order.push_back(end);
        }
        continue_variables(event.loop->body);
    }
}

/// What goes on from another variable has its name: a block's, and a loop's where nobody else reads
/// what that held last.
void Locals::name_variables(Region& region) {
    for (Event& event : region.events) {
        if (event.kind != Event::Kind::loop) continue;
        for (const auto& variable : event.loop->variables) {
            begin_[variable.get()] = event.order;
            const Node& initial = *variable->initial;
            if (const auto found = continued_.find(variable.get()); found != continued_.end())
                named_as_[variable.get()] = found->second;
            else if (is_needed(variable.get()) && initial.kind == Kind::read &&
                     uses_of(&initial) == 1 && !is_declared(&initial) &&
                     initial.index == static_cast<int>(initial.variable->version_order.size()) - 1)
                named_as_[variable.get()] = initial.variable;
        }
        name_variables(event.loop->body);
    }
}

/// Values of variables that would be read after these have changed.
void Locals::declare_changed() {
    for (bool again = true; again;) {
        again = false;
        for (const auto& node : graph_.nodes)
            if (is_needed(node.get()) && is_declared(node.get()) &&
                declare_changed_in(node.get(), node->order, true))
                again = true;
        for (const Root& root : roots_)
            if (declare_changed_in(root.node, root.order, false)) again = true;
    }
}

/// Declares the highest node below `node` that was made before a variable in it changed, where the
/// text at `order` would read the changed one.
bool Locals::declare_changed_in(Node* node, int order, bool is_top) {
    Info& info = info_[node];
    if (info.declared && !is_top) return false;
    if (node->kind == Kind::read) {
        const int end = end_of(*node);
        if (info.declared || end < 0 || end >= order) return false;
        info.declared = true;
        return true;
    }
    if (!is_top && !is_cheap(*node) && node->order < order && is_stale(node, order)) {
        info.declared = true;
        return true;
    }
    for (Node* argument : node->arguments)
        if (declare_changed_in(argument, order, false)) return true;
    return false;
}

bool Locals::is_stale(const Node* node, int order) const {
    if (node->kind == Kind::read) {
        const int end = end_of(*node);
        return end >= 0 && end < order && end > node->order;
    }
    if (is_declared(node)) return false;
    return std::any_of(node->arguments.begin(), node->arguments.end(),
                       [&](const Node* argument) { return is_stale(argument, order); });
}

}  // namespace quadrel::recorded
