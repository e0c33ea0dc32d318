// Expressions of a folded recording as text.
#pragma once

#include <string>
#include <unordered_map>

#include "export/print/dialect.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

/// How weakly operators bind.
inline constexpr int unary_level = 2, sum_level = 4, and_operand_level = 10, or_level = 13,
                     choice_level = 14;

/// The names that locals and variables have got so far, and what is written with them.
class Expressions {
  public:
    Expressions(const Graph& graph, const Dialect& dialect) : graph_(graph), dialect_(dialect) {}

    void name(const Node* node, const std::string& name) { local_names_[node] = name; }
    void name(const Variable* variable, const std::string& name) {
        variable_names_[variable] = name;
    }
    /// Whether it is a local that has been declared.
    bool is_named(const Node* node) const { return local_names_.contains(node); }
    bool is_named(const Variable* variable) const { return variable_names_.contains(variable); }
    std::string name_of(const Variable* variable) const;

    /// `within` is the weakest operator that needs no parentheses.
    std::string text(const Node* node, int within) const;
    /// What a local of its own is given.
    std::string value(const Node& node) const { return bare(node, level_of(node)); }

  private:
    int level_of(const Node& node) const;
    std::string symbol(const Node& node) const;
    std::string operands(const Node& node, int level) const;
    std::string bare(const Node& node, int level) const;
    std::string literal(const Node& node) const;

    const Graph& graph_;
    const Dialect& dialect_;
    std::unordered_map<const Node*, std::string> local_names_;
    std::unordered_map<const Variable*, std::string> variable_names_;
};

}  // namespace quadrel::recorded
