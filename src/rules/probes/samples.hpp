// Where the samples of a pixel lie.
#pragma once

#include "rules/probe.hpp"

namespace quadrel::rules {

inline constexpr int sample_count = 4, sample_steps = 16;

/// Pixel k of a row of sample_steps: covered right of an edge from k / 16 of its width at the
/// bottom to (k + 1) / 16 at the top; of a column of sample_steps, above such an edge. Its ends lie
/// on any grid of sub-pixels, and no sample in between on the edge itself.
std::vector<Triangle> moving_edges(bool along_y);

/// Four samples, by what an edge that moves over a pixel covers: x and y of each, in 1/16 pixel.
Probe sample_positions_probe();

}  // namespace quadrel::rules
