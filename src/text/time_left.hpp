// How long something will still take, for people who wait.
#pragma once

#include <string>

namespace quadrel {

/// "about 12 min left" of what has taken `seconds` and of which `share`, 0 to 1, is done; empty
/// while that cannot be told, and where it is soon over.
std::string time_left(double seconds, double share);

}  // namespace quadrel
