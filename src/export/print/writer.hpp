// A folded recording as the text of a function.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "export/print/assignments.hpp"
#include "export/print/dialect.hpp"
#include "export/print/helpers.hpp"
#include "export/print/locals.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

class Writer {
  public:
    Writer(Graph& graph, const Locals& locals, const Dialect& dialect)
        : graph_(graph), locals_(locals), dialect_(dialect), expressions_(graph, dialect) {}

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
    void choose_inputs(const std::vector<std::string>& order);
    void write_parameters();
    void write_body(const std::string& name);
    std::string unique(const std::string& hint, const char* otherwise);

    std::string text(const Node* node, int within) const { return expressions_.text(node, within); }
    std::string name_of(const Variable* variable) const { return expressions_.name_of(variable); }

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
    void write_groups(const std::vector<AssignmentGroup>& groups, bool independent, int depth);
    std::string leave_line(const Event& leave) const;

    Graph& graph_;
    const Locals& locals_;
    const Dialect& dialect_;
    Expressions expressions_;
    std::string out_;
    std::set<std::string> names_;
    std::set<std::string> changed_outputs_;  ///< outputs of an input's name
    std::vector<Named> inputs_;
};

}  // namespace quadrel::recorded
