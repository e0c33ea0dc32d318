// Masks that are known where a node is made: behind a way out of a loop those that it has asked
// for, in a block its condition.
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

class KnownMasks {
  public:
    explicit KnownMasks(const Graph& graph);

    /// Takes in what is known to nodes made after `order`; `folded` has the nodes made before.
    /// Orders never fall.
    void learn_up_to(int order, const std::unordered_map<const Node*, Node*>& folded);
    /// What a folded mask is for what is made in `region` now; nothing where that is open.
    std::optional<bool> find(const Node* mask, const Region* region) const;

  private:
    /// `mask`, as it was recorded, holds in `region` from `order` on.
    struct Fact {
        const Node* mask;
        const Region* region;
        int order;
    };
    struct Known {
        bool value;
        const Region* region;
    };

    void collect(const Region& region);
    void learn(const Node* mask, bool value, const Region* region);

    std::vector<Fact> facts_;
    std::size_t learnt_ = 0;
    std::unordered_map<const Node*, std::vector<Known>> known_;
};

}  // namespace quadrel::recorded
