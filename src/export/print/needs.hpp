// Which expressions and variables of a recording a shader needs.
#pragma once

#include <set>
#include <string>
#include <unordered_set>
#include <vector>

#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

class Needs {
  public:
    /// Outputs that are not in `wanted` are taken out of the graph; all stay if that is empty.
    Needs(Graph& graph, const std::set<std::string>& wanted);

    bool is_needed(const Node* node) const { return nodes_.count(node) != 0; }
    bool is_needed(const Variable* variable) const { return variables_.count(variable) != 0; }
    /// Names of symbols that are read.
    const std::set<std::string>& symbols() const { return symbols_; }

  private:
    void drop_unwanted(const std::set<std::string>& wanted);
    void want(Node* node);
    void want_roots(Region& region);
    void want_assignments(Region& region, const Variable* variable);

    Graph& graph_;
    std::unordered_set<const Node*> nodes_;
    std::unordered_set<const Variable*> variables_;
    std::set<std::string> symbols_;
    std::vector<Node*> work_;
};

}  // namespace quadrel::recorded
