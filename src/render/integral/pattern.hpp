// Where in its pixel each sample of an integral lies.
//
// The samples of a quad are dealt to replicates in turn. Each replicate is a Sobol' sequence of two
// dimensions, a (0, 2)-sequence, scrambled at random in the sense of Owen, and independent of all
// others: so each estimates the mean without bias, and their spread tells the error of their mean,
// while the error of one falls faster than that of as many independent samples. Every first 2^k
// samples of a replicate are stratified, so that one may stop there. Sources: A. Owen, "Randomly
// Permuted (t,m,s)-Nets and (t,s)-Sequences" (1995); B. Burley, "Practical Hash-based Owen
// Scrambling", JCGT 9(4), 2020.
#pragma once

#include <cstdint>

#include "raster/placed.hpp"

namespace quadrel {

/// The place of a sample, counted from 0, of the quad whose lane 0 is pixel (x, y) of the window.
/// A function of its arguments alone. Places are the centres of 4096 x 4096 parts of the pixel.
SamplePlace sample_place(int x, int y, int sample);

}  // namespace quadrel
