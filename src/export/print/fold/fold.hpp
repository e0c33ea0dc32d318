// Folding a recording: equal expressions become one, constants are computed, scalars that do the
// same become vectors. Nothing changes a bit: no sum is dropped but that of -0, and no comparison
// is turned around that NaN would tell.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "export/print/fold/known_masks.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// Whether `inner` is `outer` or lies in it.
bool is_within(const Region* outer, const Region* inner);
/// A literal, symbol or read.
bool is_leaf(const Node& node);
bool is_literal(const Node& node, double value);
/// Whether neighbours have a part in it: a difference, or a look-up whose level follows from one.
bool is_difference(const Node& node);

class Folder {
  public:
    explicit Folder(Graph& graph) : graph_(graph), known_masks_(graph) {}

    /// Replaces the graph's nodes by folded ones, in the order in which they were made, and makes
    /// its events and loops refer to these.
    void run();

  private:
    struct Part {
        Node* vector;
        int index;
    };

    Node* folded(const Node& node);
    /// A node that stands for an argument of `user`.
    Node* argument_of(const Node& user, const Node* argument);
    Node* folded_read(const Node& read);
    Node* simplified(Node node);
    Node* simple_choice(const Node& node);
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
    Node* rolled_choice(const std::vector<Node*>& components, const Node& at, int depth);
    void add_parts(const std::vector<Node*>& numbers, Node* vector);
    Node* part_of_vector(const Node& user, Node* number);
    Node* construct(Type type, const std::vector<Node*>& components, const Node& at);

    Graph& graph_;
    KnownMasks known_masks_;
    std::vector<std::unique_ptr<Node>> kept_;
    std::map<std::string, std::vector<Node*>> equal_;
    std::unordered_map<const Node*, Node*> folded_;
    std::unordered_map<const Node*, Part> parts_;  ///< numbers that a vector has, too
};

}  // namespace quadrel::recorded
