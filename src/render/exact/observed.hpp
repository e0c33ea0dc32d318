// What stages differentiate and store nowhere: computed once more from what is stored, for the
// channels that tell its exact derivatives.
#pragma once

#include <span>

#include "quadrel/quad/stage.hpp"
#include "render/plan/channel_source.hpp"

namespace quadrel {

/// The values that it is made of.
std::span<const Value> inputs_of(Observed what);

/// The value in whose form it comes.
Value form_of(Observed what);

/// Whether it reads the height map.
inline bool reads_heights(Observed what) { return what == Observed::height; }

/// The stage function that makes it, storing it as form_of(what); `scalar_bytes` is that of a
/// Dual, a double or a float. Calls need a height map or noise where it reads heights.
StageFunction observer(Observed what, int scalar_bytes);

}  // namespace quadrel
