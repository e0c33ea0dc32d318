// Assignments that become statements under conditions.
#pragma once

#include <string>
#include <vector>

#include "export/print/expressions.hpp"
#include "export/print/locals.hpp"

namespace quadrel::recorded {

/// Assignments under one condition, or under none.
struct AssignmentGroup {
    const Node* condition;
    std::vector<std::string> lines;
};

/// v = c ? x : v and v = v || c are conditional.
std::vector<AssignmentGroup> groups_of(const Event& event, const Expressions& expressions);

/// Whether no assignment of the event reads what another one changes.
bool are_independent(const Event& event, const Expressions& expressions);

/// Those of one condition become one.
void join_groups(std::vector<AssignmentGroup>& groups);

/// Those of opposite conditions come to stand side by side, the negated one second.
void pair_groups(std::vector<AssignmentGroup>& groups);

/// Puts the way out into the group of its condition, which then comes last; false where there is
/// none.
bool leaves_by_group(std::vector<AssignmentGroup>& groups, const Event& leave, const Locals& locals,
                     const Expressions& expressions);

}  // namespace quadrel::recorded
