// Folding a recording: equal expressions become one, constants are computed, scalars that do the
// same become vectors. Nothing changes a bit: no sum is dropped but that of -0, and no comparison
// is turned around that NaN would tell.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// Whether `inner` is `outer` or lies in it.
bool is_within(const Region* outer, const Region* inner);
/// A literal, symbol or read.
bool is_leaf(const Node& node);
bool is_literal(const Node& node, double value);

class Folder {
  public:
    explicit Folder(Graph& graph) : graph_(graph) {}

    /// Replaces the graph's nodes by folded ones, in the order in which they were made, and makes
    /// its events and loops refer to these.
    void run();

  private:
    Node* folded(const Node& node);
    Node* folded_read(const Node& read);
    Node* simplified(Node node);
    Node* named_vector(const Node& node, Node* vector);
    Node* literal(Type type, double value);
    /// The node that is equal to `node` and known where that stands; else a new one.
    Node* unique(Node node);
    void rename(Region& region);

    // What an operation is by itself; null where nothing is known (identities.cpp).
    Node* simple_logic(Node& node);
    Node* simple_sum(const Node& node);
    void subtract_negative(Node& node);
    Node* computed(const Node& node);
    Node* counted(const Node& node);
    Node* whole_again(const Node& node);

    // A vector whose components do the same, as one operation; null where they do not
    // (vectors.cpp).
    Node* rolled(const std::vector<Node*>& components, const Node& at, int depth);
    Node* rolled_leaves(const std::vector<Node*>& components, const Node& at, int depth);
    Node* rolled_operation(const std::vector<Node*>& components, const Node& at, int depth);
    Node* construct(Type type, const std::vector<Node*>& components, const Node& at);

    Graph& graph_;
    std::vector<std::unique_ptr<Node>> kept_;
    std::map<std::string, std::vector<Node*>> equal_;
    std::unordered_map<const Node*, Node*> folded_;
};

}  // namespace quadrel::recorded
