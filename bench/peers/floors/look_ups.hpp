// The look-ups of a frame, and nothing else: what no drawing of it with these look-ups can beat.
#pragma once

#include <vector>

#include "quadrel/texture/view.hpp"

namespace quadrel::peers {

/// Where a frame looks its textures up, tile by tile of 64x64 pixels, as they are drawn.
struct Places {
    std::vector<float> u, v;
    std::vector<float> du, dv;  ///< to the next sample of a march
    std::vector<float> level;   ///< of detail, of the colour map, >= 0
};

/// Nanoseconds of CPU time that a bilinear look-up of one channel takes, level 0, by the widest
/// vectors that the processor has, over maps that repeat after powers of two: the least of
/// `repeats` walks of eight samples from each place.
double height_look_up_ns(const TextureView& map, const Places& places, int repeats);

/// The same of a look-up of four channels, filtered between two levels.
double colour_look_up_ns(const TextureView& map, const Places& places, int repeats);

/// Of writing four floats for each place, planar, to memory that was written before.
double four_floats_ns(std::size_t places, int repeats);

}  // namespace quadrel::peers
