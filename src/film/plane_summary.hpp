// What a channel's values are between, band by band.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "quadrel/film/film.hpp"

namespace quadrel {

struct PlaneSummary {
    std::uint32_t least = std::numeric_limits<std::uint32_t>::max(), most = 0;  ///< of integers
    /// Of finite floats; low above high if there are none.
    float low = std::numeric_limits<float>::infinity(), high = -low;
    std::size_t nan = 0, infinite = 0;

    void add(const Plane& plane);
};

}  // namespace quadrel
