#include "export/stages/same_shape.hpp"

#include <algorithm>
#include <cmath>

namespace quadrel::recorded {
namespace {

/// Nodes of two recordings that did the same have the same place in time.
bool are_at_once(const Node* a, const Node* b) {
    return (a == nullptr) == (b == nullptr) && (a == nullptr || a->order == b->order);
}

bool are_alike(const Node& a, const Node& b) {
    return a.kind == b.kind && a.type == b.type && a.text == b.text && a.index == b.index &&
           a.order == b.order &&
           std::equal(a.arguments.begin(), a.arguments.end(), b.arguments.begin(),
                      b.arguments.end(), are_at_once);
}

bool are_alike(const Region& a, const Region& b);

bool are_alike(const Event& a, const Event& b) {
    const auto assigns_alike = [](const Assignment& x, const Assignment& y) {
        return x.version == y.version && x.order == y.order && are_at_once(x.value, y.value);
    };
    return a.kind == b.kind && a.order == b.order && a.text == b.text &&
           are_at_once(a.value, b.value) && (a.loop == nullptr) == (b.loop == nullptr) &&
           std::equal(a.assignments.begin(), a.assignments.end(), b.assignments.begin(),
                      b.assignments.end(), assigns_alike) &&
           (a.loop == nullptr ||
            (a.loop->kind == b.loop->kind && are_alike(a.loop->body, b.loop->body)));
}

bool are_alike(const Region& a, const Region& b) {
    return std::equal(a.events.begin(), a.events.end(), b.events.begin(), b.events.end(),
                      [](const Event& x, const Event& y) { return are_alike(x, y); });
}

}  // namespace

bool have_same_shape(const Graph& a, const Graph& b) {
    return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                      [](const auto& x, const auto& y) { return are_alike(*x, *y); }) &&
           are_alike(a.top, b.top);
}

bool have_same_value(const Node& a, const Node& b) {
    return (a.value == b.value && std::signbit(a.value) == std::signbit(b.value)) ||
           (std::isnan(a.value) && std::isnan(b.value));
}

bool are_equal(const Graph& a, const Graph& b) {
    return have_same_shape(a, b) &&
           std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(),
                      [](const auto& x, const auto& y) { return have_same_value(*x, *y); });
}

}  // namespace quadrel::recorded
