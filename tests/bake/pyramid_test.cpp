// Pyramids of bounds: sound, tight, and as large as they say.
#include <bit>
#include <limits>
#include <random>

#include "bake/support.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel::test {
namespace {

struct Bounds {
    double low, high;
};

using BoundsOf = std::function<Bounds(const Texture&, const SamplerState&, int i, int j)>;

/// Least and greatest bilinear height in a cell of the plane: at the corners, and at points inside,
/// which the reference sampler may round by some 1e-16.
Bounds cell_bounds(const Texture& field, const SamplerState& sampler, int i, int j) {
    Bounds bounds{std::numeric_limits<double>::infinity(), -1e300};
    for (const double y : {0.0, 0.25, 0.5, 1.0}) {
        for (const double x : {0.0, 0.3, 0.5, 1.0}) {
            const double h = bilinear_at(field, sampler, i + x, j + y);
            const double slack = (x == 0 || x == 1) && (y == 0 || y == 1) ? 0 : 1e-15;
            bounds = {std::min(bounds.low, h + slack), std::max(bounds.high, h - slack)};
        }
    }
    return bounds;
}

Bounds texel_bounds(const Texture& field, const SamplerState& sampler, int i, int j) {
    const double h = height_at(field, sampler, i, j);
    return {h, h};
}

/// Every node's maximum (last channel) and minimum (first of two) are those of its cells, exactly.
testing::AssertionResult bounds_its_cells(const Texture& map, const Texture& field,
                                          const SamplerState& sampler, const Grid& grid,
                                          const BoundsOf& bounds_of) {
    const TextureView& view = map.view();
    const auto fail = [&](int level, int i, int j) {
        return testing::AssertionFailure()
               << describe(field, sampler) << " level " << level << " node " << i << " " << j;
    };
    const int top = view.levels - 1;
    if (view.width[0] != grid.u.count || view.height[0] != grid.v.count) return fail(0, 0, 0);
    if (view.width[top] != 1 || view.height[top] != 1) return fail(top, 0, 0);
    for (int level = 0; level < view.levels; ++level) {
        const int size = 1 << level;
        if (view.width[level] != (grid.u.count + size - 1) / size) return fail(level, -1, -1);
        for (int node = 0; node < view.width[level] * view.height[level]; ++node) {
            const int i = node % view.width[level], j = node / view.width[level];
            Bounds all{std::numeric_limits<double>::infinity(), -1e300};
            for (int y = j * size; y < std::min((j + 1) * size, grid.v.count); ++y) {
                for (int x = i * size; x < std::min((i + 1) * size, grid.u.count); ++x) {
                    const Bounds b = bounds_of(field, sampler, x + grid.u.first, y + grid.v.first);
                    all = {std::min(all.low, b.low), std::max(all.high, b.high)};
                }
            }
            if (texel_of(map, level, 0, i, j, view.channels - 1) != all.high ||
                (view.channels == 2 && texel_of(map, level, 0, i, j, 0) != all.low))
                return fail(level, i, j);
        }
    }
    return testing::AssertionSuccess();
}

using GridOf = Grid (*)(int, int, const SamplerState&);

testing::AssertionResult is_pyramid(const Baker& baked, GridOf grid_of, const BoundsOf& bounds) {
    std::uint32_t seed = 0;
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 2}, {5, 3}, {1, 6}, {9, 4}, {2, 35}}) {
        const Texels field = random_field(width, height, ++seed);
        for (const SamplerState& sampler : all_samplers()) {
            const auto result = bounds_its_cells(*baked(*field, sampler), *field, sampler,
                                                 grid_of(width, height, sampler), bounds);
            if (!result) return result;
        }
    }
    return testing::AssertionSuccess();
}

Baker planted_baker(Planted planted, BakeKind kind) {
    return [=](const Texture& field, const SamplerState& sampler) {
        SamplerState other = sampler;
        if (planted == Planted::wrap_forgotten) {
            // The grid of the mode, the values of another field: rotated by half a tile.
            const TextureView& view = field.view();
            return bake(*make_field(view.width[0], view.height[0],
                                    [&](int i, int j) {
                                        return height_at(field,
                                                         sampler_with(Wrap::repeat, Wrap::repeat),
                                                         i + 1, j);
                                    }),
                        kind, sampler);
        }
        const Texels map =
            bake(field, planted == Planted::texels_not_cells ? BakeKind::texel_max : kind, other);
        const int top = map->view().levels - 1, c = map->view().channels - 1;
        if (planted == Planted::node_an_ulp_low)
            return with_value(*map, top, 0, 0, 0, c,
                              [](float v) { return std::nextafter(v, -1.f); });
        if (planted == Planted::node_an_ulp_high)
            return with_value(*map, top, 0, 0, 0, c,
                              [](float v) { return std::nextafter(v, 2.f); });
        if (planted == Planted::child_missing && map->view().width[0] > 2 && top > 0) {
            const int last = (map->view().width[0] - 1) / 2;
            return with_value(*map, 1, 0, last, 0, c,
                              [&](float) { return texel_of(*map, 0, 0, 2 * last, 0, c); });
        }
        return map;
    };
}

TEST(Pyramid, MaxMipBoundsTheBilinearField) {
    EXPECT_TRUE(is_pyramid(baker(BakeKind::max_mip), cell_grid, cell_bounds));
    for (const Planted planted :
         {Planted::wrap_forgotten, Planted::node_an_ulp_low, Planted::node_an_ulp_high,
          Planted::child_missing, Planted::texels_not_cells}) {
        EXPECT_FALSE(is_pyramid(planted_baker(planted, BakeKind::max_mip), cell_grid, cell_bounds))
            << static_cast<int>(planted);
    }
}

TEST(Pyramid, MinMaxBoundsTheBilinearFieldFromBothSides) {
    EXPECT_TRUE(is_pyramid(baker(BakeKind::min_max), cell_grid, cell_bounds));
    for (const Planted planted : {Planted::node_an_ulp_low, Planted::wrap_forgotten}) {
        EXPECT_FALSE(is_pyramid(planted_baker(planted, BakeKind::min_max), cell_grid, cell_bounds));
    }
}

TEST(Pyramid, TexelMaxBoundsTheBlocks) {
    EXPECT_TRUE(is_pyramid(baker(BakeKind::texel_max), texel_grid, texel_bounds));
    for (const Planted planted : {Planted::node_an_ulp_low, Planted::child_missing}) {
        EXPECT_FALSE(
            is_pyramid(planted_baker(planted, BakeKind::texel_max), texel_grid, texel_bounds));
    }
}

/// A NaN height is in every node above it.
testing::AssertionResult keeps_nan(const Baker& baked) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (int k = 0; k < 15; ++k) {
        const Texels field =
            make_field(5, 3, [&](int i, int j) { return j * 5 + i == k ? nan : 0.5f; });
        const Texels map = baked(*field, sampler_with(Wrap::repeat, Wrap::clamp_to_edge));
        const TextureView& view = map->view();
        for (int c = 0; c < view.channels; ++c) {
            const float top = texel_of(*map, view.levels - 1, 0, 0, 0, c);
            if (top == top) return testing::AssertionFailure() << "texel " << k << " channel " << c;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Pyramid, NanPoisonsTheNodesAbove) {
    for (const BakeKind kind : {BakeKind::max_mip, BakeKind::min_max, BakeKind::texel_max})
        EXPECT_TRUE(keeps_nan(baker(kind)));
    EXPECT_FALSE(keeps_nan([](const Texture& field, const SamplerState& sampler) {
        const Texels map = bake(field, BakeKind::max_mip, sampler);
        const int top = map->view().levels - 1;
        return with_value(*map, top, 0, 0, 0, 0, [](float) { return 0.5f; });
    })) << static_cast<int>(Planted::nan_ignored);
}

/// What a node is by definition, bit for bit: that of its lower row's pair, then of its upper's.
std::uint32_t node_bits(const Texture& finer, int x, int y, bool by_columns) {
    const TextureView& view = finer.view();
    const auto at = [&](int i, int j) {
        return texel_of(finer, 0, 0, i % view.width[0], j % view.height[0], 0);
    };
    const auto most = [](float a, float b) { return b > a || b != b ? b : a; };
    const float node =
        by_columns ? most(most(at(x, y), at(x, y + 1)), most(at(x + 1, y), at(x + 1, y + 1)))
                   : most(most(at(x, y), at(x + 1, y)), most(at(x, y + 1), at(x + 1, y + 1)));
    return std::bit_cast<std::uint32_t>(node != node ? std::numeric_limits<float>::quiet_NaN()
                                                     : node);
}

testing::AssertionResult has_the_bits(bool by_columns) {
    constexpr float special[] = {0.0f,
                                 -0.0f,
                                 std::numeric_limits<float>::quiet_NaN(),
                                 std::numeric_limits<float>::infinity(),
                                 -1.0f,
                                 0.5f};
    std::mt19937 random(8);
    const Texels field = make_field(37, 21, [&](int, int) { return special[random() % 6]; });
    const Texels map = bake(*field, BakeKind::max_mip, sampler_with(Wrap::repeat, Wrap::repeat));
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 37; ++x) {
            const float node = texel_of(*map, 0, 0, x, y, 0);
            const auto bits = std::bit_cast<std::uint32_t>(
                node != node ? std::numeric_limits<float>::quiet_NaN() : node);
            if (bits != node_bits(*field, x, y, by_columns))
                return testing::AssertionFailure() << "cell " << x << ", " << y;
        }
    return testing::AssertionSuccess();
}

/// Which zero a node has, and that it has no number, follows from the order of its texels.
TEST(Pyramid, NodesHaveTheBitsOfTheirDefinition) {
    EXPECT_TRUE(has_the_bits(false));
    EXPECT_FALSE(has_the_bits(true));
}

}  // namespace
}  // namespace quadrel::test
