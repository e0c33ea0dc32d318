// The reduction of one mip level to the next, in double, row by row.
#pragma once

#include <memory>
#include <vector>

#include "quadrel/texture/format.hpp"

namespace quadrel {

/// Rows of a level before rounding, interleaved. `scratch` may be used to make them in; the row
/// stays as it is until `scratch` is used again.
class LevelRows {
  public:
    virtual ~LevelRows() = default;
    virtual const double* row(int y, std::vector<double>& scratch) const = 0;
};

/// A level of unrounded values in memory.
class WideLevel : public LevelRows {
  public:
    /// Its values are to be written before they are read.
    WideLevel(int width, int height, int channels);

    const double* row(int y, std::vector<double>&) const override { return at(y); }
    double* row(int y) { return at(y); }

    const int width, height, channels;

  private:
    double* at(int y) const {
        return values_.get() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(channels);
    }
    std::unique_ptr<double[]> values_;
};

/// Row `y` of `to` by the box rule, from the rows 2y and 2y + 1 of a level of `width` texels (each
/// clamped to the last): of the texels 2x and 2x + 1 (clamped) (a + b) + (c + d), then a quarter.
void box_row(const double* upper, const double* lower, int width, WideLevel& to, int y);

/// Row `y` of `to` by the area rule, from a level of `width` x `height` texels: the mean over each
/// texel's area, row by row.
void area_row(const LevelRows& from, int width, int height, WideLevel& to, int y);

}  // namespace quadrel
