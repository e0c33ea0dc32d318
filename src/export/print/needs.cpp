#include "export/print/needs.hpp"

#include <algorithm>

namespace quadrel::recorded {

using Kind = Node::Kind;

Needs::Needs(Graph& graph, const std::set<std::string>& wanted) : graph_(graph) {
    drop_unwanted(wanted);
    want_roots(graph_.top);
    while (!work_.empty()) {
        Node* const node = work_.back();
        work_.pop_back();
        if (node->kind == Kind::symbol) symbols_.insert(node->text);
        for (Node* argument : node->arguments) want(argument);
        if (node->kind != Kind::read || !variables_.insert(node->variable).second) continue;
        want(node->variable->initial);
        want_assignments(graph_.top, node->variable);
    }
}

void Needs::drop_unwanted(const std::set<std::string>& wanted) {
    if (wanted.empty()) return;
    std::erase_if(graph_.outputs, [&](const Named& of) { return wanted.count(of.name) == 0; });
    std::erase_if(graph_.top.events, [&](const Event& event) {
        return event.kind == Event::Kind::store && wanted.count(event.text) == 0;
    });
}

void Needs::want(Node* node) {
    if (nodes_.insert(node).second) work_.push_back(node);
}

void Needs::want_assignments(Region& region, const Variable* variable) {
    for (Event& event : region.events) {
        for (const Assignment& assignment : event.assignments)
            if (assignment.variable == variable) want(assignment.value);
        if (event.kind == Event::Kind::loop) want_assignments(event.loop->body, variable);
    }
}

void Needs::want_roots(Region& region) {
    for (Event& event : region.events) {
        if (event.value != nullptr) want(event.value);
        if (event.kind != Event::Kind::loop) continue;
        for (Node* of : {event.loop->condition, event.loop->first, event.loop->last})
            if (of != nullptr) want(of);
        for (const auto& variable : event.loop->variables)
            if (variable->guards) want(variable->initial);
        want_roots(event.loop->body);
    }
}

}  // namespace quadrel::recorded
