// Names for what a text computes, put into a copy of its source.
#pragma once

#include <string>

#include "tools/annotate/source_text.hpp"

namespace quadrel::annotate {

/// The source with `named("low", ...)` around right-hand sides of declarations and assignments, the
/// comments in front of them included; around results, by the function's name, weakly; with a scope
/// for each `if (when(mask))`, which `branch` makes.
std::string with_names(const std::string& text, const Structs& structs);

}  // namespace quadrel::annotate
