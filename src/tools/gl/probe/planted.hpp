// Whether probes notice a preset that is not what was seen.
#pragma once

#include <string>

namespace quadrel::gl {

/// Changes each term of the preset of a renderer (whose terms are not those of `exact`) by itself.
/// Returns those of which no probe that agrees with the preset tells a difference; empty: all are
/// told.
std::string unnoticed_terms(const std::string& preset);

/// How many terms that are.
int term_count();

}  // namespace quadrel::gl
