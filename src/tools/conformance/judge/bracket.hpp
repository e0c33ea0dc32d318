// Between which results a value lies.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadrel::conformance {

/// What a value may be between; NaN where some result is.
struct Bracket {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    bool nan = false;

    void include(double value) {
        nan |= std::isnan(value);
        low = std::min(low, std::isnan(value) ? low : value);
        high = std::max(high, std::isnan(value) ? high : value);
    }
    /// Ends are off by `rounding`.
    bool contains(double value, double rounding) const {
        return std::isnan(value) ? nan : low - rounding <= value && value <= high + rounding;
    }
};

}  // namespace quadrel::conformance
