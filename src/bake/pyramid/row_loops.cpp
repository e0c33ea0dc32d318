#include "bake/pyramid/row_loops.hpp"

#include "texture/row_loop.hpp"

namespace quadrel::row_loops {

QUADREL_ROW_LOOP void copy_known(const float* __restrict from, std::size_t count,
                                 float* __restrict to) {
    for (std::size_t k = 0; k < count; ++k) to[k] = known(from[k]);
}

QUADREL_ROW_LOOP float largest_size(const float* from, std::size_t count, std::size_t stride) {
    const auto size_of = [](float height) {
        const float size = std::fabs(height);
        return size < largest_height ? size : 0;
    };
    // Side by side, so that no comparison waits for the one before.
    constexpr std::size_t side_by_side = 64;
    float largest_of_each[side_by_side] = {}, largest = 0;
    std::size_t i = 0;
    if (stride == 1)
        for (; i + side_by_side <= count; i += side_by_side)
            for (std::size_t k = 0; k < side_by_side; ++k)
                largest_of_each[k] = greater(size_of(from[i + k]), largest_of_each[k]);
    for (; i < count; ++i) largest = greater(size_of(from[i * stride]), largest);
    for (const float size : largest_of_each) largest = greater(size, largest);
    return largest;
}

QUADREL_ROW_LOOP void reduce_sides(const float* __restrict a, const float* __restrict b,
                                   const float* __restrict c, std::size_t count,
                                   float* __restrict highest, float* __restrict steepest) {
    for (std::size_t k = 0; k < count; ++k) {
        highest[k] = greater(greater(a[k], b[k]), c[k]);
        steepest[k] = greater(difference(a[k], b[k]), difference(b[k], c[k]));
    }
}

QUADREL_ROW_LOOP void reduce_columns(const float* __restrict a, const float* __restrict b,
                                     const float* __restrict c, const float* __restrict highest,
                                     const float* __restrict steepest, std::size_t count,
                                     float* __restrict column_highest,
                                     float* __restrict column_steepest) {
    for (std::size_t k = 0; k < count; ++k) {
        column_highest[k] = greater(highest[k], highest[k + 1]);
        const float outer = greater(difference(a[k], a[k + 1]), difference(c[k], c[k + 1]));
        const float across = greater(outer, difference(b[k], b[k + 1]));
        column_steepest[k] = greater(across, greater(steepest[k], steepest[k + 1]));
    }
}

QUADREL_ROW_LOOP void greater_of_pairs(const float* __restrict from, std::size_t count,
                                       float margin, float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = greater(from[2 * i], from[2 * i + 1]) + margin;
}

QUADREL_ROW_LOOP void greatest_of_blocks(const float* __restrict a, const float* __restrict b,
                                         std::size_t count, float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i)
        to[i] = greater(greater(a[2 * i], a[2 * i + 1]), greater(b[2 * i], b[2 * i + 1]));
}

QUADREL_ROW_LOOP void raise_to(const float* __restrict from, std::size_t count,
                               float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = greater(to[i], from[i]);
}

QUADREL_ROW_LOOP void greatest_of_fours(const float* __restrict from, std::size_t count,
                                        float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) {
        const float* const four = from + 2 * i - 1;
        to[i] = greater(greater(four[0], four[1]), greater(four[2], four[3]));
    }
}

}  // namespace quadrel::row_loops
