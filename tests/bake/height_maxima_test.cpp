// Bounds of parts of a height map: no look-up is above them, and no surface steeper.
#include "bake/pyramid/height_maxima.hpp"

#include "effort.hpp"
#include "quadrel/relief/trace/search/height_ceiling.hpp"
#include "relief/march/lattice_rays.hpp"

namespace quadrel::test {
namespace {

/// Coordinates in the last ulps before a texel's centre, where filters round up, or anywhere.
double coordinate(Random& random, int texels) {
    if (random.chance(0.3)) return random.uniform(-3, 3);
    const double centre = (random.integer(-texels, 2 * texels) + 0.5) / texels;
    return static_cast<double>(static_cast<float>(centre - random.below(4) * 0x1p-24));
}

/// Look-ups in one level of wild maps against the ceilings of boxes around them.
testing::AssertionResult ceilings_hold(const std::function<void(DamagedMaxima&)>& damage) {
    const std::vector<StressMap> kinds = wild_maps();
    for (std::size_t i = 0; i < kinds.size() * 6; ++i) {
        Random random(i + 1);
        const Map map = make_wild_map(kinds[i % kinds.size()], random);
        const auto owned = height_maxima(*map.texture, map.sampled.sampler);
        DamagedMaxima maxima(owned->maxima);
        if (damage) damage(maxima);
        for (int n = 0; n < rounds(200); ++n) {
            const int level = random.below(maxima.maxima.levels);
            const LevelMaxima& of = maxima.maxima.level[level];
            const double u = coordinate(random, of.width), v = coordinate(random, of.height);
            const auto geometry = level_geometry<float>(map.sampled.view, level);
            const float h = sample_linear<1, float>(map.sampled, geometry,
                                                    {static_cast<float>(u), static_cast<float>(v)})
                                .channel[0];
            const double margin = 0x1p-20, size = random.chance(0.5) ? 0 : random.uniform(0, 1.5);
            const UvBox box{u - size * random.uniform(0, 1) - margin,
                            u + size * random.uniform(0, 1) + margin, v - margin, v + margin};
            const float ceiling = height_ceiling(of, box, owned->maxima.slack);
            if (!(h <= ceiling) && !std::isinf(ceiling))
                return testing::AssertionFailure()
                       << h << " above " << ceiling << " on " << kinds[i % kinds.size()].name
                       << ", level " << level << ", " << u << " " << v;
        }
    }
    return testing::AssertionSuccess();
}

TEST(HeightMaxima, NoLookUpIsAboveThem) {
    EXPECT_TRUE(ceilings_hold({}));
    // Nodes as they would be without what filters round up.
    EXPECT_FALSE(ceilings_hold([](DamagedMaxima& m) {
        for (int level = 0; level < m.maxima.levels; ++level)
            for (float& node : m.nodes(level)) node -= m.maxima.rounding;
    }));
    // Without the texels beside: cells from one further on.
    EXPECT_FALSE(ceilings_hold([](DamagedMaxima& m) {
        for (int level = 0; level < m.maxima.levels; ++level) --m.maxima.level[level].first_y;
    }));
    EXPECT_FALSE(ceilings_hold([](DamagedMaxima& m) {
        for (LevelMaxima& level : m.maxima.level) level.repeat_x = 0;
    }));
}

/// The nodes of a map that repeats, from their definition.
TEST(HeightMaxima, AreThoseOfTheFourTexelsOfEachCell) {
    Random random(3);
    const Map map = noise_map(random, 13, 6);
    const auto maxima = height_maxima(*map.texture, map.sampled.sampler);
    const TextureView& view = map.sampled.view;
    const auto texel = [&](int x, int y) { return view.texels[(y % 6) * 13 + x % 13]; };
    const TextureView& nodes = maxima->maxima.level[0].nodes;
    ASSERT_EQ(nodes.width[0], 7);
    ASSERT_EQ(nodes.height[0], 3);
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 7; ++i) {
            float greatest = 0;
            for (int y = 0; y <= 2; ++y)
                for (int x = 0; x <= (i == 6 ? 1 : 2); ++x)
                    greatest = std::max(greatest, texel(2 * i + x, 2 * j + y));
            EXPECT_EQ(nodes.texels[j * 7 + i], greatest + maxima->maxima.rounding);
        }
    EXPECT_EQ(nodes.width[nodes.levels - 1], 1);
}

TEST(HeightMaxima, AreMadeOnce) {
    Random random(4);
    const Map map = noise_map(random, 16, 16);
    const auto first = height_maxima(*map.texture, map.sampled.sampler);
    const auto again = height_maxima(*map.texture, map.sampled.sampler);
    EXPECT_EQ(first->made, 1);
    EXPECT_EQ(again->made, 0);
    EXPECT_EQ(first->textures[0], again->textures[0]);
    SamplerState clamped = map.sampled.sampler;
    clamped.wrap_u = Wrap::clamp_to_edge;
    EXPECT_EQ(height_maxima(*map.texture, clamped)->made, 1);
    // A third of the texels for the pyramid, a sixteenth for the slopes, and what rounds up.
    EXPECT_LE(first->bytes(), std::size_t(16 * 16 * 4 * 0.45));
}

}  // namespace
}  // namespace quadrel::test
