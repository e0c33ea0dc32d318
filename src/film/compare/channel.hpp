// The comparison of one channel, pixel by pixel.
#pragma once

#include "quadrel/compare.hpp"

namespace quadrel {

/// Both planes have the same type and the film's window.
ChannelReport compare_channel(const Window& window, const Plane& reference, const Plane& test,
                              const CompareRules& rules);

}  // namespace quadrel
