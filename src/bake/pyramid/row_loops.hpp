// Loops over rows of heights that bounds of a height map are made by. Rows must not overlap.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

namespace quadrel::row_loops {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
/// Filters of greater heights may overflow.
inline constexpr float largest_height = 0x1p100f;

/// In this form loops become vector instructions.
inline float greater(float a, float b) { return a > b ? a : b; }
inline float known(float height) { return std::fabs(height) < largest_height ? height : infinity; }
inline float difference(float x, float y) {
    const float size = std::fabs(x - y);
    return size < infinity ? size : infinity;
}

void copy_known(const float* from, std::size_t count, float* to);
/// The greatest magnitude below largest_height, 0 if there is none.
float largest_size(const float* from, std::size_t count, std::size_t stride);
/// Of the left sides of columns of cells, between three rows of heights: the greatest height and
/// the greatest difference.
void reduce_sides(const float* a, const float* b, const float* c, std::size_t count, float* highest,
                  float* steepest);
/// Of columns of cells, both sides and what lies between.
void reduce_columns(const float* a, const float* b, const float* c, const float* highest,
                    const float* steepest, std::size_t count, float* column_highest,
                    float* column_steepest);
/// Value i: the greater of 2 i and 2 i + 1.
void greater_of_pairs(const float* from, std::size_t count, float margin, float* to);
/// Value i: the greatest of a 2x2 block of two rows.
void greatest_of_blocks(const float* a, const float* b, std::size_t count, float* to);
void raise_to(const float* from, std::size_t count, float* to);
/// Value i: the greatest of `from` 2 i - 1 to 2 i + 2.
void greatest_of_fours(const float* from, std::size_t count, float* to);

}  // namespace quadrel::row_loops
