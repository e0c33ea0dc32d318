#include "export/print/fold/known_masks.hpp"

#include <algorithm>

#include "export/print/fold/fold.hpp"

namespace quadrel::recorded {

using Kind = Node::Kind;

KnownMasks::KnownMasks(const Graph& graph) {
    collect(graph.top);
    std::stable_sort(facts_.begin(), facts_.end(),
                     [](const Fact& a, const Fact& b) { return a.order < b.order; });
}

void KnownMasks::collect(const Region& region) {
    for (const Event& event : region.events) {
        if (event.kind == Event::Kind::leave) facts_.push_back({event.value, &region, event.order});
        if (event.kind != Event::Kind::loop) continue;
        const Loop& loop = *event.loop;
        if (loop.condition != nullptr) facts_.push_back({loop.condition, &loop.body, loop.order});
        collect(loop.body);
    }
}

void KnownMasks::learn_up_to(int order, const std::unordered_map<const Node*, Node*>& folded) {
    for (; learnt_ < facts_.size() && facts_[learnt_].order < order; ++learnt_) {
        const Fact& fact = facts_[learnt_];
        learn(folded.at(fact.mask), true, fact.region);
    }
}

/// Of both that hold each does, and of either that does not neither.
void KnownMasks::learn(const Node* mask, bool value, const Region* region) {
    if (mask->kind == Kind::literal) return;
    known_[mask].push_back({value, region});
    const bool is_all = mask->kind == Kind::binary && mask->text == (value ? "&&" : "||");
    const bool is_negation = mask->kind == Kind::unary && mask->text == "!";
    if (is_all || is_negation)
        for (const Node* argument : mask->arguments) learn(argument, value != is_negation, region);
}

std::optional<bool> KnownMasks::find(const Node* mask, const Region* region) const {
    const auto found = known_.find(mask);
    if (found == known_.end()) return {};
    for (const Known& known : found->second)
        if (is_within(known.region, region)) return known.value;
    return {};
}

}  // namespace quadrel::recorded
