// Rays traced in packets.
#pragma once

#include "embree/geometry.hpp"

namespace quadrel::peers {

/// What the rays met, in their order.
struct Traced {
    std::vector<float> depth;       ///< of the hit, infinite where there is none
    std::vector<std::uint8_t> lit;  ///< whether nothing lies between hit and light
};

/// Traces the rays from `first` to `last`, multiples of 16, by `packet` (8 or 16) at a time down to
/// `depth`; then those towards the light where `shadows`.
void trace_packets(RTCScene scene, const Rays& rays, std::size_t first, std::size_t last,
                   int packet, float depth, bool shadows, Traced& traced);

}  // namespace quadrel::peers
