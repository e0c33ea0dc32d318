// What a render tells people when it is done.
#pragma once

#include <optional>
#include <string>

#include "quadrel/stats.hpp"

namespace quadrel::cli {

/// One line: pixels covered, time by phase, what was left out.
std::string summary_line(const RenderSummary& summary);

/// Why there is nothing to see; nothing if there is something.
std::optional<std::string> nothing_in_view(const RenderSummary& summary);

}  // namespace quadrel::cli
