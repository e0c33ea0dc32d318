// The header for users' unit tests, used as a user would; its example runs here.
#include "quadrel/testing.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace {

using namespace quadrel;

template <class F>
class Testing : public ::testing::Test {};
using NumberTypes = ::testing::Types<Quad<float>, Quad<double>>;
TYPED_TEST_SUITE(Testing, NumberTypes);

TYPED_TEST(Testing, ExampleOfTheHeader) {
    using F = TypeParam;
    using T = Scalar<F>;
    const auto q = unit::run_quad<F>(10, 20, [](const auto& xy) { return xy * F(T(1) / 64); });
    EXPECT_EQ(q.dFdx_fine(0), vec2<T>(T(1) / 64, 0));
    const auto mip = unit::select_level({256, 256}, q.dFdx_fine(0), q.dFdy_fine(0));
    EXPECT_EQ(mip.level, 2.0);
}

TYPED_TEST(Testing, FineTakesItsOwnRowAndCoarseTheFirst) {
    using F = TypeParam;
    const auto q = unit::run_quad<F>(6, 4, [](const auto& xy) { return xy.x * xy.y; });
    // d(xy)/dx over the row at y is y.
    EXPECT_EQ(q.dFdx_fine(0), 4.5);
    EXPECT_EQ(q.dFdx_fine(3), 5.5);
    EXPECT_EQ(q.dFdx_coarse(3), 4.5);
    EXPECT_EQ(q.dFdy_fine(1), 7.5);
    EXPECT_EQ(q.dFdy_coarse(1), 6.5);
}

TYPED_TEST(Testing, OddPixelsBelongToTheQuadOfTheEvenOnes) {
    using F = TypeParam;
    const auto position = [](const auto& xy) { return xy; };
    const auto even = unit::run_quad<F>(6, 4, position);
    const auto odd = unit::run_quad<F>(7, 5, position);
    for (int lane = 0; lane < 4; ++lane) EXPECT_EQ(even[lane], odd[lane]);
    EXPECT_EQ(even[3].x, 7.5);
}

TYPED_TEST(Testing, FreePositionsNeedNoGrid) {
    using F = TypeParam;
    const std::array<vec2<double>, 4> at{vec2<double>(0, 0), vec2<double>(2, 0), vec2<double>(0, 3),
                                         vec2<double>(2, 3)};
    const auto q = unit::run_quad<F>(at, [](const auto& xy) { return xy; });
    EXPECT_EQ(q.dFdx_fine(2).x, 2);
    EXPECT_EQ(q.dFdy_fine(1).y, 3);
}

/// 4x4 ramp: texel (x, y) is 10 y + x.
std::shared_ptr<const Texture> ramp() {
    Image image;
    image.width = image.height = 4;
    image.channels = 1;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) image.values.push_back(static_cast<float>(10 * y + x));
    return make_texture(image);
}

TYPED_TEST(Testing, TouchedTexelsReproduceTheLookUp) {
    using F = TypeParam;
    using T = Scalar<F>;
    const auto texture = ramp();
    for (const Filter filter : {Filter::nearest, Filter::linear}) {
        SampledTexture sampled{texture->view(), {}};
        sampled.sampler.min = sampled.sampler.mag = filter;
        for (const T scale : {T(0.01), T(0.3), T(0.45), T(2)}) {
            const vec2<T> uv(T(0.37), T(0.81)), dx(scale, 0), dy(0, scale / 2);
            const auto footprint = unit::touched_texels(sampled, uv, dx, dy);
            double sum = 0, weight = 0;
            for (const TexelTap& tap : footprint.taps) {
                sum += tap.weight * tap.value[0];
                weight += tap.weight;
            }
            const auto b = [](const vec2<T>& v) { return vec2<F>(F(v.x), F(v.y)); };
            const auto fetched =
                texture_grad(sampled, SampleContext<F>(), b(uv), b(dx), b(dy)).x.lane[0];
            EXPECT_NEAR(weight, 1, 1e-6) << footprint;
            EXPECT_NEAR(sum, fetched, 1e-4) << footprint;
        }
    }
}

TYPED_TEST(Testing, BorderTapsSaySo) {
    using T = Scalar<TypeParam>;
    const auto texture = ramp();
    SampledTexture sampled{texture->view(), {}};
    sampled.sampler.wrap_u = sampled.sampler.wrap_v = Wrap::clamp_to_border;
    sampled.sampler.border[0] = 7;
    const auto footprint =
        unit::touched_texels(sampled, vec2<T>(0, T(0.5)), vec2<T>(T(0.01), 0), vec2<T>(0, T(0.01)));
    ASSERT_EQ(footprint.taps.size(), 4u);
    EXPECT_TRUE(footprint.taps[0].border);
    EXPECT_EQ(footprint.taps[0].value[0], 7);
    EXPECT_FALSE(footprint.taps[1].border);
}

TEST(TestingPrint, RecordsPrintTheirNumbers) {
    std::ostringstream out;
    out << unit::select_level({64, 64}, vec2<float>(1.0f / 16, 0), vec2<float>(0, 1.0f / 64));
    EXPECT_EQ(out.str(), "rho 4 lambda 2 level 2 frac 0");
}

}  // namespace
