// Range-maximum tables: every layer by its definition, and every rectangle by four look-ups.
#include "bake/support.hpp"
#include "quadrel/relief/cells.hpp"

namespace quadrel::test {
namespace {

int floor_log2(int n) { return n > 1 ? 1 + floor_log2(n / 2) : 0; }

/// The greatest height of a rectangle of cells, by their corners.
double greatest_of(const Texture& field, const SamplerState& sampler, int i, int j, int width,
                   int height) {
    double most = -1e300;
    for (int y = 0; y <= height; ++y)
        for (int x = 0; x <= width; ++x)
            most = std::max(most, height_at(field, sampler, i + x, j + y));
    return most;
}

testing::AssertionResult answers_rectangles(const Texture& map, const Texture& field,
                                            const SamplerState& sampler) {
    const Grid grid = cell_grid(field.view().width[0], field.view().height[0], sampler);
    const int last_a = floor_log2(grid.u.count), last_b = floor_log2(grid.v.count);
    if (map.view().faces != (last_a + 1) * (last_b + 1))
        return testing::AssertionFailure() << map.view().faces << " layers";
    std::mt19937 random(61);
    for (int trial = 0; trial < 60; ++trial) {
        const int width = 1 + static_cast<int>(random() % grid.u.count);
        const int height = 1 + static_cast<int>(random() % grid.v.count);
        const int i = static_cast<int>(random() % grid.u.count);
        const int j = static_cast<int>(random() % grid.v.count);
        const int a = floor_log2(width), b = floor_log2(height);
        float most = -1;
        for (int k = 0; k < 4; ++k) {
            const int x = i + (k % 2 ? width - (1 << a) : 0),
                      y = j + (k / 2 ? height - (1 << b) : 0);
            most = std::max(most, texel_of(map, 0, b * (last_a + 1) + a,
                                           stored_index<double>(x + grid.u.first, grid.u),
                                           stored_index<double>(y + grid.v.first, grid.v)));
        }
        if (most != greatest_of(field, sampler, i + grid.u.first, j + grid.v.first, width, height))
            return testing::AssertionFailure() << width << "x" << height << " at " << i << " " << j;
    }
    return testing::AssertionSuccess();
}

TEST(Rmq, AnswersRectangles) {
    const Baker real = baker(BakeKind::rmq);
    EXPECT_TRUE(holds_for_small_fields(real, answers_rectangles));
    EXPECT_FALSE(holds_for_small_fields(
        changed(real, [](float v, int, int layer, int, int,
                         int) { return layer == 3 ? std::nextafter(v, -1.0f) : v; }),
        answers_rectangles))
        << static_cast<int>(Planted::lowered);
    EXPECT_FALSE(holds_for_small_fields(
        [&](const Texture& field, const SamplerState& sampler) {
            const Texels map = real(field, sampler);
            return with_values(*map, [&](float v, int, int layer, int i, int j, int) {
                return layer > 0 ? texel_of(*map, 0, layer - 1, i, j) : v;
            });
        },
        answers_rectangles))
        << static_cast<int>(Planted::layers_turned);
}

}  // namespace
}  // namespace quadrel::test
