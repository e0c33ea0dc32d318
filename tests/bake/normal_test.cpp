// Normal maps: planes give their own normals, whatever the kernel.
#include "bake/support.hpp"

namespace quadrel::test {
namespace {

constexpr double depth = 0.25;

BakeOptions quarter_deep() {
    BakeOptions options;
    options.parameters["depth"] = depth;
    return options;
}

/// Normals of the plane h = 0.2 + a u + b v, away from the texture's edges.
testing::AssertionResult knows_planes(const Baker& baked) {
    const int width = 12, height = 7;
    for (const auto& [a, b] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, -0.1}, {0.3, 0.25}}) {
        const Texels plane = make_field(width, height, [&, a = a, b = b](int i, int j) {
            return 0.2 + a * i / width + b * j / height;
        });
        const Texels map = baked(*plane, sampler_with(Wrap::clamp_to_edge, Wrap::clamp_to_edge));
        const double length = std::sqrt(depth * depth * (a * a + b * b) + 1);
        const double expected[] = {0.5 - 0.5 * depth * a / length, 0.5 - 0.5 * depth * b / length,
                                   0.5 + 0.5 / length};
        for (int k = 0; k < (width - 2) * (height - 2); ++k) {
            const int i = 1 + k % (width - 2), j = 1 + k / (width - 2);
            for (int c = 0; c < 3; ++c) {
                if (std::abs(texel_of(*map, 0, 0, i, j, c) - expected[c]) > 1e-5)
                    return testing::AssertionFailure()
                           << "slopes " << a << " " << b << " component " << c << ": "
                           << texel_of(*map, 0, 0, i, j, c) << " for " << expected[c];
            }
            if (texel_of(*map, 0, 0, i, j, 3) != texel_of(*plane, 0, 0, i, j))
                return testing::AssertionFailure() << "height";
        }
    }
    return testing::AssertionSuccess();
}

Baker planted_normals(Planted planted, BakeKind kind) {
    BakeOptions options = quarter_deep();
    if (planted == Planted::doubled_slopes) options.parameters["depth"] = 2 * depth;
    const Baker real = baker(kind, options);
    if (planted != Planted::green_flipped) return real;
    return changed(real, [](float v, int, int, int, int, int c) { return c == 1 ? 1 - v : v; });
}

TEST(Normal, KernelsKnowPlanes) {
    for (const BakeKind kind :
         {BakeKind::normal_gather, BakeKind::normal_4tap, BakeKind::normal_sobel}) {
        EXPECT_TRUE(knows_planes(planted_normals(Planted::none, kind)));
        EXPECT_FALSE(knows_planes(planted_normals(Planted::doubled_slopes, kind)));
        EXPECT_FALSE(knows_planes(planted_normals(Planted::green_flipped, kind)));
    }
}

/// Where each kernel feels a single raised texel.
TEST(Normal, KernelsReachAsFarAsTheySay) {
    const Texels impulse = make_field(7, 7, [](int i, int j) { return i == 3 && j == 3 ? 1 : 0; });
    const SamplerState sampler = sampler_with(Wrap::repeat, Wrap::repeat);
    const auto touched = [&](BakeKind kind) {
        const Texels map = bake(*impulse, kind, sampler);
        int count = 0;
        for (int k = 0; k < 49; ++k) count += texel_of(*map, 0, 0, k % 7, k / 7, 2) != 1.0f;
        return count;
    };
    EXPECT_EQ(touched(BakeKind::normal_gather), 4);
    EXPECT_EQ(touched(BakeKind::normal_4tap), 4);
    EXPECT_EQ(touched(BakeKind::normal_sobel), 8);
}

}  // namespace
}  // namespace quadrel::test
