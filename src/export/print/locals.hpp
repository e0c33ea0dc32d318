// Which expressions of a folded recording a shader needs, and which of them are locals: what is
// used more than once, what the text has named, and what would be read after a loop has changed it.
#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "export/print/needs.hpp"
#include "quadrel/num/shader/graph.hpp"

namespace quadrel::recorded {

class Locals {
  public:
    /// Outputs that are not in `wanted` are left out; all stay if that is empty. Events that nobody
    /// needs are taken out of the graph.
    Locals(Graph& graph, const std::set<std::string>& wanted);

    bool is_needed(const Node* node) const { return needs_.is_needed(node); }
    bool is_declared(const Node* node) const { return find(node).declared; }
    bool is_needed(const Variable* variable) const { return needs_.is_needed(variable); }
    /// How often it is used.
    std::size_t uses_of(const Node* node) const { return find(node).uses.size(); }
    /// The variable around it whose name it has, since it goes on from it; null where it is one of
    /// its own.
    Variable* named_as(const Variable* variable) const;
    /// The variable that an assignment just before has given the condition to stay in a loop.
    Variable* condition_of(const Event* leave) const;
    /// Where a value is assigned to a variable as soon as it is computed, and has its name until
    /// that changes; null where it is a local.
    const Assignment* assignment_of(const Node* node) const;
    /// Names of symbols that are read.
    const std::set<std::string>& symbols() const { return needs_.symbols(); }

  private:
    struct Use {
        const Node* node;  ///< null: of an event
        int order;
        const Region* region;
    };
    struct Info {
        bool declared = false;
        std::vector<Use> uses;
    };
    struct Root {
        Node* node;
        int order;
        const Region* region;
        bool is_assigned;
    };

    const Info& find(const Node* node) const;

    void collect_roots(Region& region);
    void order_assignments(Event& event);
    const std::set<const Variable*>& reads_of(const Node* node);

    void count_uses();
    void declare();
    bool declare_difference(Node* node);
    void declare_if_used_much(Node* node, const std::set<const Node*>& assigned);
    void declare_vectors();
    const Region* place_of(const Node* node) const;
    void continue_variables(Region& region);
    void declare_changed();
    bool declare_changed_in(Node* node, int order, bool is_top);
    bool is_stale(const Node* node, int order) const;

    void name_variables(Region& region);

    // What a variable holds as soon as it is computed (assigned_at_once.cpp).
    void assign_at_once(Region& region);
    void assign_values(const Region& region, Event& event);
    void assign_steps(const Region& region, const Assignment& to, int from, int event);
    bool may_hold(const Region& region, const Assignment& to, const Node* value, int event) const;
    bool reads_older(const Node* node, const Assignment& to, int event) const;
    int next_change(const Region& region, const Event& event, const Assignment& of) const;
    bool has_same_name(const Variable* a, const Variable* b) const;
    int last_use_of(const Node* node) const;

    Graph& graph_;
    Needs needs_;
    std::unordered_map<const Node*, Info> info_;
    std::unordered_map<const Variable*, Variable*> continued_, named_as_;
    std::unordered_map<const Variable*, int> begin_;  ///< when their loops begin
    std::unordered_map<const Event*, Variable*> conditions_;
    std::unordered_map<const Node*, Assignment> at_once_;
    std::unordered_map<const Node*, std::set<const Variable*>> reads_;
    std::vector<Root> roots_;
};

}  // namespace quadrel::recorded
