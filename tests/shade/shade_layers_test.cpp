// shade-layers: over each depth layer what shade-blinn-phong makes of that layer's own colours.
#include "relief/layer/layer_maps.hpp"
#include "shade/lighting.hpp"

namespace quadrel::test {
namespace {

constexpr std::array layer_colors{TextureSlot::color, TextureSlot::color_2, TextureSlot::color_3,
                                  TextureSlot::color_4};

/// Points on all of four layers, in turn; hits lie next to them, not on them.
struct PointsOnLayers {
    Map layers = make_map(
        2, 2, 4, [](int, int, int c) { return 0.15f + 0.2f * static_cast<float>(c); },
        plain_sampler());
    Batch<float> batch;

    explicit PointsOnLayers(Random& random) : batch(random_points(random, 2)) {
        for (int lane = 0; lane < batch.lanes; ++lane)
            batch.real(Value::hit_s, lane) =
                static_cast<float>(0.15 + 0.2 * layer_of(lane) + random.uniform(-0.09, 0.09));
        batch.bind(TextureSlot::layers, layers.sampled);
    }
    PointsOnLayers(const PointsOnLayers&) = delete;
    static int layer_of(int lane) { return lane / 4 % 4; }
};

/// With maps for the layers of `mapped` (a bit each), lanes have the colours of their own layer's
/// map, or of the first one's. `shift`: an error planted, maps of the layers behind.
testing::AssertionResult layers_have_their_colors(unsigned mapped, int shift = 0) {
    Random random(21);
    PointsOnLayers points(random);
    std::vector<Map> maps;
    for (int layer = 0; layer < 4; ++layer)
        maps.push_back(constant_map({static_cast<float>(0.2 + 0.2 * layer),
                                     static_cast<float>(0.9 - 0.2 * layer), 0.5f,
                                     static_cast<float>(1 - 0.1 * layer)}));
    Batch<float> found = points.batch;
    for (int layer = 0; layer < 4; ++layer)
        if ((mapped >> layer & 1) != 0)
            found.bind(layer_colors[static_cast<std::size_t>(layer)],
                       maps[static_cast<std::size_t>((layer + shift) % 4)].sampled);
    found.run("shade-layers");
    for (int layer = 0; layer < 4; ++layer) {
        const int of = (mapped >> layer & 1) != 0 ? layer : 0;
        Batch<float> plain = points.batch;
        if ((mapped >> of & 1) != 0)
            plain.bind(TextureSlot::color, maps[static_cast<std::size_t>(of)].sampled);
        plain.run("shade-blinn-phong");
        for (int lane = 0; lane < plain.lanes; ++lane) {
            if (PointsOnLayers::layer_of(lane) != layer) continue;
            if (plain.vector3(Value::color, lane) != found.vector3(Value::color, lane) ||
                plain.real(Value::opacity, lane) != found.real(Value::opacity, lane))
                return testing::AssertionFailure() << "layer " << layer << ", lane " << lane;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ShadeLayers, EachLayerHasItsColors) {
    for (unsigned mapped = 0; mapped < 16; ++mapped)
        EXPECT_TRUE(layers_have_their_colors(mapped)) << mapped;
    for (const int shift : {1, 2, 3}) EXPECT_FALSE(layers_have_their_colors(15, shift)) << shift;
}

/// Of a map of two channels the layers behind are at the bottom, and none of them is met.
TEST(ShadeLayers, LayersThatAMapLacksHaveNone) {
    Random random(22);
    PointsOnLayers points(random);
    const Map two = make_map(
        2, 2, 2, [](int, int, int c) { return 0.15f + 0.2f * static_cast<float>(c); },
        plain_sampler());
    const Map front = constant_map({1, 0, 0, 1}), back = constant_map({0, 0, 1, 1}),
              none = constant_map({0, 1, 0, 1});
    Batch<float>& batch = points.batch;
    for (int lane = 0; lane < batch.lanes; ++lane)
        batch.real(Value::hit_s, lane) = lane % 2 == 0 ? 0.15f : 0.35f;
    batch.bind(TextureSlot::layers, two.sampled);
    for (const TextureSlot slot : layer_colors) batch.bind(slot, none.sampled);
    batch.bind(TextureSlot::color, front.sampled);
    batch.bind(TextureSlot::color_2, back.sampled);
    batch.run("shade-layers");
    for (int lane = 0; lane < batch.lanes; ++lane) {
        EXPECT_EQ(batch.real(Value::light_ambient, lane, 1), 0) << lane;
        EXPECT_EQ(batch.real(Value::light_ambient, lane, lane % 2 == 0 ? 2 : 0), 0) << lane;
    }
}

}  // namespace
}  // namespace quadrel::test
