// The pyramid over depth layers: least fronts and greatest backs of what is solid, node by node.
#include <cmath>

#include "bake/support.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel::test {
namespace {

/// Sorted depths in `channels` channels, a third of the pairs without thickness.
Texels random_layers(int width, int height, int channels, std::uint32_t seed) {
    std::mt19937 random(seed);
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    for (int texel = 0; texel < width * height; ++texel) {
        float depths[4];
        for (float& depth : depths) depth = static_cast<float>(random() >> 8) * 0x1p-24f;
        std::sort(depths, depths + 4);
        if (random() % 3 == 0) depths[1] = depths[0];
        if (random() % 3 == 0) depths[3] = depths[2];
        for (int c = 0; c < channels; ++c) image.values.push_back(depths[c]);
    }
    TextureOptions options;
    options.mip_rule = MipRule::none;
    return make_texture(image, options);
}

/// Channel c of a texel of the plane; 1 where the map has none.
float depth_at(const Texture& layers, const SamplerState& sampler, int i, int j, int c) {
    if (c >= layers.view().channels) return 1;
    const TextureView& view = layers.view();
    const bool inside = inside_level<float>(i, view.width[0], sampler.wrap_u) &&
                        inside_level<float>(j, view.height[0], sampler.wrap_v);
    if (!inside) return sampler.border[c];
    return texel_of(layers, 0, 0, wrap_index<float>(i, view.width[0], sampler.wrap_u),
                    wrap_index<float>(j, view.height[0], sampler.wrap_v), c);
}

/// Every node of every level holds the bounds of all solid cells below it, and no more.
testing::AssertionResult bounds_what_is_solid(const Baker& bake_with) {
    for (int channels : {1, 2, 4})
        for (SamplerState sampler : all_samplers()) {
            sampler.border[1] = 0.8f;
            const Texels layers = random_layers(7, 5, channels, 17);
            const Texels map = bake_with(*layers, sampler);
            const Grid cells = cell_grid(7, 5, sampler);
            const TextureView& view = map->view();
            for (int level = 0; level < view.levels; ++level)
                for (int node = 0; node < view.width[level] * view.height[level]; ++node) {
                    const int x = node % view.width[level], y = node / view.width[level];
                    float expected[4] = {2, -1, 2, -1};
                    for (int row = y << level; row < std::min((y + 1) << level, cells.v.count);
                         ++row)
                        for (int column = x << level;
                             column < std::min((x + 1) << level, cells.u.count); ++column)
                            for (int pair = 0; pair < 4; pair += 2) {
                                float front[4], back[4];
                                bool solid = false;
                                for (int corner = 0; corner < 4; ++corner) {
                                    const int i = cells.u.first + column + corner % 2;
                                    const int j = cells.v.first + row + corner / 2;
                                    front[corner] = depth_at(*layers, sampler, i, j, pair);
                                    back[corner] = depth_at(*layers, sampler, i, j, pair + 1);
                                    solid |= front[corner] < back[corner];
                                }
                                for (int corner = 0; solid && corner < 4; ++corner) {
                                    expected[pair] = std::min(expected[pair], front[corner]);
                                    expected[pair + 1] = std::max(expected[pair + 1], back[corner]);
                                }
                            }
                    for (int c = 0; c < 4; ++c)
                        if (texel_of(*map, level, 0, x, y, c) != expected[c])
                            return testing::AssertionFailure()
                                   << channels << " channels, " << describe(*layers, sampler)
                                   << ", level " << level << ", node " << node << ", channel " << c;
                }
        }
    return testing::AssertionSuccess();
}

TEST(LayerBounds, BoundWhatIsSolid) {
    EXPECT_TRUE(bounds_what_is_solid(baker(BakeKind::layer_bounds)));
    EXPECT_FALSE(bounds_what_is_solid([](const Texture& layers, const SamplerState& sampler) {
        return with_value(*bake(layers, BakeKind::layer_bounds, sampler), 1, 0, 0, 0, 1,
                          [](float v) { return v - 0.01f; });
    }));
    EXPECT_FALSE(bounds_what_is_solid([](const Texture& layers, const SamplerState&) {
        return bake(layers, BakeKind::layer_bounds, sampler_with(Wrap::repeat, Wrap::repeat));
    }));
}

/// Every channel is part of the identity; of heights only the first.
TEST(LayerBounds, IdentityHoldsEveryChannel) {
    const SamplerState sampler = sampler_with(Wrap::repeat, Wrap::repeat);
    const Texels layers = random_layers(4, 4, 4, 3);
    const Texels other = with_value(*layers, 0, 0, 2, 1, 3, [](float v) { return v + 0.5f; });
    EXPECT_NE(baked_id(*layers, BakeKind::layer_bounds, sampler),
              baked_id(*other, BakeKind::layer_bounds, sampler));
    EXPECT_EQ(baked_id(*layers, BakeKind::max_mip, sampler),
              baked_id(*other, BakeKind::max_mip, sampler));
}

TEST(LayerBounds, BrokenLayersAreNan) {
    const Texels layers = random_layers(4, 4, 2, 3);
    const Texels broken = with_value(*layers, 0, 0, 2, 1, 1, [](float) { return std::nanf(""); });
    const Texels map =
        bake(*broken, BakeKind::layer_bounds, sampler_with(Wrap::repeat, Wrap::repeat));
    const int top = map->view().levels - 1;
    EXPECT_TRUE(std::isnan(texel_of(*map, top, 0, 0, 0, 0)));
    EXPECT_TRUE(std::isnan(texel_of(*map, top, 0, 0, 0, 1)));
    EXPECT_EQ(texel_of(*map, top, 0, 0, 0, 2), 2);
}

}  // namespace
}  // namespace quadrel::test
