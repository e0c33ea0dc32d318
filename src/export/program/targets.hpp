// What a program's targets hold: the values that its stages are to give, and how they are put
// together.
#pragma once

#include <string>

#include "export/program/entry_point.hpp"
#include "export/program/stage_calls.hpp"
#include "export/table.hpp"

namespace quadrel::recorded {

/// Whether a target holds a level of detail.
bool asks_lod(const ProgramRequest& request);

/// What targets, depth and discarding are made of.
ValueTypes wanted_values(const ProgramRequest& request);

PassTargets targets_of(const ProgramRequest& request, const Dialect& dialect);

/// When a fragment is discarded; empty: never.
std::string discard_condition(const ProgramRequest& request, const Dialect& dialect);

}  // namespace quadrel::recorded
