// The grid of dual cells that stands for the whole plane under each wrap mode.
#include "quadrel/relief/cells.hpp"

#include "bake/support.hpp"

namespace quadrel::test {
namespace {

using AxisOf = std::function<GridAxis(int texels, Wrap)>;

AxisOf planted_axis(Planted planted) {
    return [planted](int texels, Wrap wrap) {
        GridAxis axis = cell_axis(texels, wrap);
        if (planted == Planted::first_cell_missing && !axis.periodic) ++axis.first, --axis.count;
        if (planted == Planted::last_cell_missing) --axis.count;
        if (planted == Planted::cell_too_many && !axis.periodic) ++axis.count;
        if (planted == Planted::mirror_by_one_tile && wrap == Wrap::mirrored_repeat)
            axis.count = texels;
        return axis;
    };
}

/// The texels at both ends of a cell, -1 for the border.
using Ends = std::pair<int, int>;

Ends ends_in_plane(int cell, int texels, Wrap wrap) {
    return {reference_wrap(cell, texels, wrap), reference_wrap(cell + 1, texels, wrap)};
}

Ends ends_in_grid(int stored, const GridAxis& axis, int texels, Wrap wrap) {
    const auto t = cell_texels<float>(stored, axis, texels, wrap);
    return {t.first_inside ? t.first : -1, t.second_inside ? t.second : -1};
}

/// Every cell of the plane has the corners of the stored cell that stands for it.
testing::AssertionResult stands_for_the_plane(const AxisOf& axis_of) {
    for (const Wrap wrap : all_wraps) {
        for (const int texels : {1, 2, 3, 8, 13}) {
            const GridAxis axis = axis_of(texels, wrap);
            for (int cell = -5 * texels - 3; cell <= 5 * texels + 3; ++cell) {
                const int stored = stored_index<float>(cell, axis);
                if (stored >= 0 && stored < axis.count &&
                    ends_in_grid(stored, axis, texels, wrap) == ends_in_plane(cell, texels, wrap))
                    continue;
                return testing::AssertionFailure() << "cell " << cell << " of " << texels
                                                   << " texels, wrap " << static_cast<int>(wrap);
            }
        }
    }
    return testing::AssertionSuccess();
}

/// No stored cell of an axis could be left out.
testing::AssertionResult has_no_cell_twice(const AxisOf& axis_of) {
    for (const Wrap wrap : all_wraps) {
        const int texels = 5;
        const GridAxis axis = axis_of(texels, wrap);
        if (axis.periodic) continue;
        for (const int end : {0, axis.count - 2}) {
            if (ends_in_grid(end, axis, texels, wrap) == ends_in_grid(end + 1, axis, texels, wrap))
                return testing::AssertionFailure() << "wrap " << static_cast<int>(wrap);
        }
    }
    return testing::AssertionSuccess();
}

TEST(Cells, StandForThePlane) {
    EXPECT_TRUE(stands_for_the_plane(cell_axis));
    for (const Planted planted :
         {Planted::first_cell_missing, Planted::last_cell_missing, Planted::mirror_by_one_tile}) {
        EXPECT_FALSE(stands_for_the_plane(planted_axis(planted))) << static_cast<int>(planted);
    }
}

TEST(Cells, NoneIsStoredTwice) {
    EXPECT_TRUE(has_no_cell_twice(cell_axis));
    EXPECT_FALSE(has_no_cell_twice(planted_axis(Planted::cell_too_many)));
}

TEST(Cells, TexelsStandForThePlaneToo) {
    for (const Wrap wrap : all_wraps) {
        for (const int texels : {1, 2, 7}) {
            const GridAxis axis = texel_axis(texels, wrap);
            for (int i = -5 * texels; i <= 5 * texels; ++i) {
                const int stored = stored_index<float>(i, axis);
                ASSERT_EQ(reference_wrap(axis.first + stored, texels, wrap),
                          reference_wrap(i, texels, wrap))
                    << i << " wrap " << static_cast<int>(wrap);
            }
        }
    }
}

template <class F>
class CellNumbers : public testing::Test {};
using NumberTypes = testing::Types<float, double, Quad<float>, Quad<double>>;
TYPED_TEST_SUITE(CellNumbers, NumberTypes);

TYPED_TEST(CellNumbers, RemaindersOfLargeIndices) {
    using F = TypeParam;
    std::mt19937 random(5);
    for (int k = 0; k < 20000; ++k) {
        const int n = 1 + static_cast<int>(random() % (k % 2 ? 131072 : 100));
        const int span = 1 << 24;
        int i = static_cast<int>(random() % (2 * span + 1)) - span;
        if (k % 3 == 0) i -= i % n - k % 5 + 2;  // beside a multiple
        i = std::max(-span, std::min(span, i));
        std::int32_t lane[lanes_of<F>];
        store(lane, floor_mod<F>(Int<F>(i), n));
        ASSERT_EQ(lane[0], ((i % n) + n) % n) << i << " mod " << n;
    }
}

/// Corner heights, blended, are what the sampler gives.
TYPED_TEST(CellNumbers, HeightsAreTheSamplers) {
    using F = TypeParam;
    std::mt19937 random(6);
    const RandomTexture texture(5, 3, 2);
    for (const SamplerState& sampler : all_samplers()) {
        const SampledTexture sampled{texture.sampled.view, sampler};
        const Grid cells = cell_grid(5, 3, sampler);
        for (int k = 0; k < 200; ++k) {
            const int i = static_cast<int>(random() % 41) - 20;
            const int j = static_cast<int>(random() % 41) - 20;
            const auto h = cell_heights<F>(sampled, cells, stored_index<F>(Int<F>(i), cells.u),
                                           stored_index<F>(Int<F>(j), cells.v));
            ASSERT_EQ(first_lane(h.h00), reference_texel(sampled, 0, i, j, 0));
            ASSERT_EQ(first_lane(h.h10), reference_texel(sampled, 0, i + 1, j, 0));
            ASSERT_EQ(first_lane(h.h01), reference_texel(sampled, 0, i, j + 1, 0));
            ASSERT_EQ(first_lane(h.h11), reference_texel(sampled, 0, i + 1, j + 1, 0));
        }
    }
}

}  // namespace
}  // namespace quadrel::test
