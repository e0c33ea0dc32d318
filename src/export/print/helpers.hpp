// Functions of a text that recording has written out in each place where they are called: what is
// computed the same way several times, of other values, becomes a function again.
//
// A candidate is an expression with all that is computed for it alone, in one region. Two are the
// same function where both do the same operations in the same order, which changes no bit. Its
// name is the one that the text's own function has, where a result bears it.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "export/print/needs.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// A function of one result, the only thing that its graph stores.
struct Helper {
    std::string name;
    Type type = Type::real;
    Graph graph;
};

class Helpers {
  public:
    /// `graph` is folded; outputs that are not in `wanted` are taken out of it. Names begin with
    /// `prefix`. Where a helper is called, `graph` has a call.
    Helpers(Graph& graph, const std::set<std::string>& wanted, const std::string& prefix);

    /// Each after those that it calls.
    const std::vector<std::unique_ptr<Helper>>& all() const { return all_; }

  private:
    /// What is computed for `root` alone, and what that is computed of.
    struct Cone {
        Node* root;
        std::string key;                ///< equal for the same function
        std::vector<Node*> arguments;   ///< in the order in which they are met
        std::vector<const Node*> body;  ///< likewise
        int size;                       ///< operations
    };

    void count_uses(const Needs& needs);
    void use(const Node* node) { ++uses_[node]; }
    bool is_body(const Node& node, const Node& root) const;
    std::set<const Node*> alone_for(const Node& root) const;
    Cone cone_of(Node* root) const;
    std::string described(const Node* node, Cone& cone, const std::set<const Node*>& body,
                          std::unordered_map<const Node*, int>& known) const;
    bool is_global(const Node& node) const;
    std::vector<Cone> best_group(const Needs& needs) const;
    void extract(std::vector<Cone>& group, const std::string& prefix);

    Graph& graph_;
    std::unordered_map<const Node*, std::size_t> uses_;
    std::vector<std::unique_ptr<Helper>> all_;
    std::set<std::string> names_;
};

}  // namespace quadrel::recorded
