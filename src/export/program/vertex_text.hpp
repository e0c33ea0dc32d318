// What a program's vertex shader makes of its attributes.
#pragma once

#include <vector>

#include "export/program/entry_point.hpp"
#include "export/program/stage_calls.hpp"
#include "export/table.hpp"

namespace quadrel::recorded {

/// `varyings`: that the fragments read. Without a comment.
VertexText vertex_text(const ProgramRequest& request, const std::vector<Varying>& varyings,
                       const StageCalls& calls, const Dialect& dialect);

}  // namespace quadrel::recorded
