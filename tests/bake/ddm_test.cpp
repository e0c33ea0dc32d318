// Directional distance maps: no ray of a range meets the field above the height that is stored, and
// the height is no needless one.
#include "bake/support.hpp"
#include "quadrel/error.hpp"
#include "quadrel/relief/direction_table.hpp"

namespace quadrel::test {
namespace {

constexpr double range_depth = 0.3;

BakeOptions ranges(int columns, int slices, int directions) {
    BakeOptions options;
    options.parameters = {{"columns", columns},
                          {"slices", slices},
                          {"directions", directions},
                          {"depth", range_depth}};
    return options;
}

/// A start in a block: anywhere in its cells, and beyond the outermost of an axis that ends.
double start_in(std::mt19937& random, int block, int blocks, const GridAxis& axis) {
    const int side = block_side(axis.count, blocks), first = block * side;
    double low = first, high = std::min(first + side, axis.count);
    if (!axis.periodic && block == 0) low -= 3;
    if (!axis.periodic && block == blocks - 1) high += 3;
    return axis.first + low + (high - low) * static_cast<double>(random() >> 8) * 0x1p-24;
}

/// Random rays of random entries stay above the field down to the stored height.
testing::AssertionResult frees_its_rays(const Texture& map, const Texture& field,
                                        const SamplerState& sampler) {
    const TextureView &view = map.view(), &heights = field.view();
    const Grid grid = cell_grid(heights.width[0], heights.height[0], sampler);
    const int columns = view.width[1], rows = view.height[1];
    const int directions = view.width[0] / columns, slices = view.faces;
    std::mt19937 random(17);
    const auto below = [&](int n) { return static_cast<int>(random() % n); };
    const auto part = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (int trial = 0; trial < 400; ++trial) {
        const int i = below(columns), j = below(rows), k = below(slices);
        const int a = below(directions), b = below(directions);
        const float free = texel_of(map, 0, k, a * columns + i, b * rows + j);
        const double z = (k + part()) / slices;
        if (z <= free) continue;
        const auto coordinate = [&](int n) { return 2 * (n + part()) / directions - 1; };
        const vec2<double> K = direction_of_square(coordinate(a), coordinate(b)) * range_depth;
        const double x = start_in(random, i, columns, grid.u);
        const double y = start_in(random, j, rows, grid.v);
        for (int n = 0; n <= 24; ++n) {
            const double fall = (z - free) * n / 24;
            const double height = bilinear_at(field, sampler, x + K.x * heights.width[0] * fall,
                                              y + K.y * heights.height[0] * fall);
            if (height <= z - fall + 1e-6) continue;
            return testing::AssertionFailure()
                   << "column " << i << " " << j << " slice " << k << " range " << a << " " << b
                   << ": free down to " << free << ", but " << height << " at " << z - fall;
        }
    }
    return testing::AssertionSuccess();
}

/// On small fields with spikes, walls and steps, by blocks of one cell and of more.
testing::AssertionResult frees_rays_of_small_fields(
    const std::function<Texels(const Texels& map)>& change) {
    for (const int columns : {3, 64}) {
        const Baker real = baker(BakeKind::ddm, ranges(columns, 3, 4));
        const auto result = holds_for_small_fields(
            [&](const Texture& field, const SamplerState& sampler) {
                return change(real(field, sampler));
            },
            frees_its_rays);
        if (!result) return result;
    }
    return testing::AssertionSuccess();
}

/// The values of one direction in another's place, or of a slice.
Texels turned_ranges(const Texels& map, int slices, int directions) {
    const TextureView& view = map->view();
    const int columns = view.width[1];
    return with_values(*map, [&](float v, int level, int layer, int i, int j, int) {
        if (level > 0) return v;
        const int other = (i + directions * columns) % view.width[0];
        return texel_of(*map, 0, (layer + slices) % view.faces, other, j);
    });
}

TEST(Ddm, FreesEveryRayOfItsRanges) {
    EXPECT_TRUE(frees_rays_of_small_fields([](const Texels& map) { return map; }));
    EXPECT_FALSE(frees_rays_of_small_fields([](const Texels& map) {
        return with_values(*map, [](float v, int, int, int, int, int) { return v - 0.03f; });
    })) << static_cast<int>(Planted::lowered);
    EXPECT_FALSE(frees_rays_of_small_fields([](const Texels& map) {
        return turned_ranges(map, 0, 2);
    })) << static_cast<int>(Planted::sectors_turned);
    EXPECT_FALSE(frees_rays_of_small_fields([](const Texels& map) {
        return turned_ranges(map, 1, 0);
    })) << static_cast<int>(Planted::layers_turned);
    const auto clamped = [](const Texture& field, const SamplerState&) {
        const SamplerState other = sampler_with(Wrap::clamp_to_edge, Wrap::clamp_to_edge);
        return bake(field, BakeKind::ddm, other, ranges(64, 3, 4));
    };
    // Rays to the right meet the wall again, only if the field repeats.
    const Texels wall = make_field(6, 4, [](int i, int) { return i == 0 ? 1.0 : 0.0; });
    EXPECT_FALSE(frees_its_rays(*clamped(*wall, repeat()), *wall, repeat()))
        << static_cast<int>(Planted::wrap_forgotten);
}

/// Level 1 is the least of all directions: what frees any ray.
testing::AssertionResult frees_all_directions(const Texture& map) {
    const TextureView& view = map.view();
    const int columns = view.width[1], rows = view.height[1];
    for (int k = 0; k < view.faces; ++k) {
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                float most = -1;
                for (int y = j; y < view.height[0]; y += rows)
                    for (int x = i; x < view.width[0]; x += columns)
                        most = std::max(most, texel_of(map, 0, k, x, y));
                if (texel_of(map, 1, k, i, j) != most)
                    return testing::AssertionFailure() << i << " " << j << " " << k;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(Ddm, KnowsWhatIsFreeInAllDirections) {
    const Texels map = bake(*random_field(9, 6, 3), BakeKind::ddm, repeat(), ranges(4, 3, 3));
    EXPECT_TRUE(frees_all_directions(*map));
    EXPECT_EQ(texel_of(*map, 2, 2, 0, 0), static_cast<float>(range_depth));
    EXPECT_FALSE(frees_all_directions(
        *with_value(*map, 1, 1, 2, 1, 0, [](float v) { return std::nextafter(v, -1.0f); })));
}

/// Over a flat field every ray is free down to it, from every slice that is not below it.
testing::AssertionResult ends_on_the_plane(const Texture& map) {
    const TextureView& view = map.view();
    for (int k = view.faces / 2; k < view.faces; ++k)
        for (int j = 0; j < view.height[0]; ++j)
            for (int i = 0; i < view.width[0]; ++i)
                if (texel_of(map, 0, k, i, j) != 0.5f)
                    return testing::AssertionFailure() << texel_of(map, 0, k, i, j);
    return testing::AssertionSuccess();
}

TEST(Ddm, EndsOnAPlane) {
    const Texels flat = make_field(7, 5, [](int, int) { return 0.5; });
    const Baker real = baker(BakeKind::ddm, ranges(3, 4, 5));
    EXPECT_TRUE(ends_on_the_plane(*real(*flat, repeat())));
    const Baker raised =
        changed(real, [](float v, int, int, int, int, int) { return std::nextafter(v, 2.0f); });
    EXPECT_FALSE(ends_on_the_plane(*raised(*flat, repeat()))) << static_cast<int>(Planted::raised);
}

/// The mean height down to which rays are free, over all directions by their part of the square.
double mean_free(const Texture& map) {
    const TextureView& view = map.view();
    double sum = 0;
    for (int k = 0; k < view.faces; ++k)
        for (int j = 0; j < view.height[0]; ++j)
            for (int i = 0; i < view.width[0]; ++i) sum += texel_of(map, 0, k, i, j);
    return sum / (static_cast<double>(view.faces) * view.width[0] * view.height[0]);
}

/// Each of the three resolutions frees more where it is finer.
TEST(Ddm, FreesMoreWhereItIsFiner) {
    std::mt19937 random(9);
    const Texels spikes =
        make_field(32, 32, [&](int, int) { return random() % 61 == 0 ? 1.0 : 0.1; });
    const auto mean = [&](int columns, int slices, int directions) {
        return mean_free(
            *bake(*spikes, BakeKind::ddm, repeat(), ranges(columns, slices, directions)));
    };
    EXPECT_LT(mean(32, 4, 8), mean(32, 4, 4) - 0.01);
    EXPECT_LT(mean(32, 4, 8), mean(8, 4, 8) - 0.01);
    EXPECT_LT(mean(32, 8, 8), mean(32, 4, 8) - 0.01);
}

/// What would be too large is refused with the figure, before anything is made.
TEST(Ddm, RefusesTablesThatAreTooLarge) {
    const Texels wide = make_field(512, 512, [](int, int) { return 0.5; });
    try {
        bake(*wide, BakeKind::ddm, repeat(), ranges(512, 64, 64));
        ADD_FAILURE() << "a table of 256 GiB";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(" 262308 MiB"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("at most 512 MiB"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace quadrel::test
