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

/// Looks at the first `lanes` lanes of the arrays that `stage` stored (`values` by slot, null where
/// not planned): codes, flags and counts within their ranges, no negative depth, and no hit without
/// a ray parameter unless its ray was no number either. Variants as published, whose mistakes are
/// theirs, are held to the codes alone.
std::optional<BorderFault> find_border_fault(const PlannedStage& stage, void* const* values,
                                             int lanes, int scalar_bytes);

}  // namespace quadrel
