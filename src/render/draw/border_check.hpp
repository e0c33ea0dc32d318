// What every stage promises of what it stores, looked at in every render: a mistake of a stage is
// caught where it is made, not where it shows.
#pragma once

#include <optional>
#include <string>

#include "render/plan/plan.hpp"

namespace quadrel {

/// A value that a stage must not store.
struct BorderFault {
    int lane = 0;
    std::string text;  ///< stage, value, what was found and what is allowed
};

/// The rules that the stage could break: about values that it stores and that are among `planned`.
/// Variants as published, whose mistakes are theirs, are held to codes alone.
BorderChecks border_checks(const PlannedStage& stage, const ValueSet& planned);

/// Looks at the first `lanes` lanes of the arrays that `stage` stored (`values` by slot, null where
/// not planned), by the rules in `stage.checks`: codes, flags and counts within their ranges, no
/// negative depth, and no hit without a ray parameter unless its ray was no number either.
std::optional<BorderFault> find_border_fault(const PlannedStage& stage, void* const* values,
                                             int lanes, int scalar_bytes);

}  // namespace quadrel
