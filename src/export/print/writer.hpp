// A folded recording as the text of a function.
#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "export/print/dialect.hpp"
#include "export/print/helpers.hpp"
#include "export/print/locals.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

class Writer {
  public:
    Writer(Graph& graph, const Locals& locals, const Dialect& dialect)
        : graph_(graph), locals_(locals), dialect_(dialect) {}

    /// `inputs` in the order in which the function has them; those that it does not read are left
    /// out. No local has a name of `taken`.
    std::string function(const std::string& name, const std::vector<std::string>& inputs,
                         const std::vector<std::string>& taken);

    /// A helper, whose graph this writer has.
    std::string helper(const Helper& helper);

    /// What the function reads and gives, once it is written.
    const std::vector<Named>& inputs() const { return inputs_; }
    const std::vector<Named>& outputs() const { return graph_.outputs; }

  private:
    /// Assignments under one condition, or under none.
    struct Group {
        const Node* condition;
        std::vector<std::string> lines;
    };

    void choose_inputs(const std::vector<std::string>& order);
    void write_parameters();
    void write_body(const std::string& name);
    std::string unique(const std::string& hint, const char* otherwise);

    // Expressions: `within` is the weakest operator that needs no parentheses.
    int level_of(const Node& node) const;
    std::string symbol(const Node& node) const;
    std::string operands(const Node& node, int level) const;
    std::string text(const Node* node, int within) const;
    std::string bare(const Node& node, int level) const;
    std::string literal(const Node& node) const;
    std::string name_of(const Variable* variable) const;

    // Statements.
    void line(int depth, const std::string& text);
    void region(const Region& region, int depth);
    void declare(const Node& node, int depth);
    void write_store(const Event& event, int depth);
    void write_loop(const Loop& loop, int depth);
    std::string guard_of(const Loop& loop) const;
    void begin_variables(const Loop& loop, int depth);
    std::string begin_of(const Loop& loop) const;
    std::string condition_of(const Loop& loop) const;
    void write_assignments(const Event& event, const Event* leave, int depth);
    std::vector<Group> groups_of(const Event& event) const;
    bool are_independent(const Event& event) const;
    bool touches(const Node* node, const Variable* variable) const;
    static void join_groups(std::vector<Group>& groups);
    bool leaves_by_group(std::vector<Group>& groups, const Event& leave) const;
    void write_groups(const std::vector<Group>& groups, bool independent, int depth);
    std::string leave_line(const Event& leave) const;

    Graph& graph_;
    const Locals& locals_;
    const Dialect& dialect_;
    std::string out_;
    std::set<std::string> names_;
    std::unordered_map<const Node*, std::string> local_names_;
    std::unordered_map<const Variable*, std::string> variable_names_;
    std::set<std::string> changed_outputs_;  ///< outputs of an input's name
    std::vector<Named> inputs_;
};

}  // namespace quadrel::recorded
