// What the judge has found, pixel by pixel, for renders that differ in their search alone: it takes
// longer than all that it judges.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "quadrel/raster/coverage.hpp"

namespace quadrel {

class Batch;

/// Of renders whose scenes, sizes and number types are equal but for what the judge does not read:
/// material.trace and what that reads. One sample per pixel. For any number of threads.
class KnownTruths {
  public:
    /// Pixels of the frame.
    KnownTruths(int width, int height);

    /// Fills a batch that has been loaded with these quads; false, with some of it filled in, where
    /// a covered pixel is not known. Helper lanes stay as they are.
    bool load(const QuadCoverage* quads, int count, Batch& truth) const;
    /// Keeps what a batch that has run holds.
    void store(const QuadCoverage* quads, int count, const Batch& truth);

  private:
    std::size_t pixel(const QuadCoverage& quad, int lane) const {
        return static_cast<std::size_t>(lane_y(quad, lane)) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(lane_x(quad, lane));
    }
    /// Whether the batch has arrays of the values that are kept.
    bool fits(const Batch& truth) const;

    int width_;
    std::once_flag settled_;
    std::vector<int> slots_;                          ///< by the first batch that was stored
    std::vector<std::uint32_t> triangles_;            ///< of each pixel; no_triangle: not known
    std::vector<std::vector<std::uint64_t>> values_;  ///< bits: [slot][pixel]
};

}  // namespace quadrel
