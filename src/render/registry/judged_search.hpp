// Which searches the judge of first hits knows.
#pragma once

#include "quadrel/relief/registry.hpp"

namespace quadrel {

/// Whether a search's rays are straight, over one height a place: the judge knows no others. Rays
/// that may pass the relief are bent, or go through layers, but for those of an image that is
/// warped for the view, which has what straight rays meet or nothing.
bool is_judged(const StageInfo& trace);

}  // namespace quadrel
