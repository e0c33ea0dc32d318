// Where the samples of a pixel lie.
#pragma once

#include "gl/probe/probe.hpp"

namespace quadrel::gl {

/// Four samples, by what an edge that moves over a pixel covers.
Probe sample_positions_probe();

}  // namespace quadrel::gl
