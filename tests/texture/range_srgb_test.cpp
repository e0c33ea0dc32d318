// What filtered sRGB8 may be where texels are decoded a little wrong, against sums of such texels.
#include "quadrel/texture/range/srgb.hpp"

#include <gtest/gtest.h>

#include "effort.hpp"
#include "random.hpp"

namespace quadrel::test {
namespace {

/// A map of this budget, as far as decoding asks for it.
class DecodedMap {
  public:
    explicit DecodedMap(double srgb) {
        texture_.view.texels = &texel_;
        RangeContext& context = range_context();
        context.budget.srgb = srgb;
        context.srgb_maps = maps_;
        context.srgb_map_count = 1;
    }
    DecodedMap(const DecodedMap&) = delete;
    DecodedMap& operator=(const DecodedMap&) = delete;
    ~DecodedMap() {
        range_context().budget = ErrorBudget();
        range_context().srgb_map_count = 0;
    }
    const SampledTexture& texture() const { return texture_; }
    RealInterval decoded(double value, int channel = 0) const {
        return range_detail::decoded(texture_, channel, value);
    }

  private:
    float texel_ = 0;
    const float* maps_[1] = {&texel_};
    SampledTexture texture_{};
};

/// Eight texels of a trilinear look-up, all of whose codes are off by `off` at most; codes 0 and
/// 255 are not.
struct WeighedCodes {
    double code[8], weight[8];

    explicit WeighedCodes(Random& random) {
        const int brightest = random.uniform(0, 1) < 0.5 ? 30 : 255;
        double sum = 0;
        for (int i = 0; i < 8; ++i) {
            code[i] = std::floor(random.uniform(0, 1) * random.uniform(0, brightest + 1));
            weight[i] = random.uniform(0, 1) < 0.5 ? 0 : random.uniform(0, 1);
            sum += weight[i];
        }
        if (sum == 0) weight[0] = sum = 1;
        for (double& w : weight) w /= sum;
    }
    double value(const auto& off) const {
        double all = 0;
        for (double const& c : code) {
            const double by = c == 0 || c == 255 ? 0 : off();
            all += weight[&c - code] * srgb_decode((c + by) / 255);
        }
        return all;
    }
};

/// Whether sums of texels that are off by `off` codes lie within what `claimed` permits.
bool sums_are_held(double off, double claimed) {
    const DecodedMap map(claimed);
    Random random(7);
    bool all = true;
    for (int i = 0; i < rounds(4000); ++i) {
        const WeighedCodes codes(random);
        const RealInterval range = map.decoded(codes.value([] { return 0.0; }));
        const auto holds = [&](double x) { return x >= range.lo - 1e-12 && x <= range.hi + 1e-12; };
        all &= holds(codes.value([&] { return off; })) &&
               holds(codes.value([&] { return -off; })) &&
               holds(codes.value([&] { return random.uniform(-off, off); }));
    }
    return all;
}

TEST(RangeSrgb, HoldsSumsOfTexels) {
    for (const double off : {0.01, 0.35, 0.5, 1.0}) {
        EXPECT_TRUE(sums_are_held(off, off)) << off;
        EXPECT_FALSE(sums_are_held(off, 0.9 * off)) << off;
    }
}

/// Of dark sums it must permit more than of a texel by itself.
TEST(RangeSrgb, DarkSumsMoveFurtherThanTheirOwnCode) {
    const double off = 0.5 / 255, code = 30.0 / 255, weight = 0.25;
    const auto sum = [&](double by) {
        return weight * srgb_decode(code + by) + (1 - weight) * srgb_decode(1.0 / 255 + by);
    };
    const double own = srgb_decode(srgb_encode(sum(0)) + off);
    EXPECT_GT(sum(off), own);
    EXPECT_LE(sum(off), DecodedMap(0.5).decoded(sum(0)).hi);
}

TEST(RangeSrgb, IsNoWiderThanItMustBe) {
    const DecodedMap map(0.5);
    for (int code = 40; code < 255; ++code) {
        const RealInterval range = map.decoded(srgb_decode(code / 255.0));
        const double least = srgb_decode((code - 0.5) / 255),
                     most = srgb_decode((code + 0.5) / 255);
        EXPECT_LE(range.hi - most, 1e-6) << code;
        EXPECT_LE(range.width(), 1.03 * (most - least)) << code;
    }
}

TEST(RangeSrgb, LeavesWhatIsExact) {
    const DecodedMap map(0.5);
    for (const double end : {0.0, 1.0}) EXPECT_TRUE(map.decoded(end).is_point()) << end;
    EXPECT_TRUE(map.decoded(0.5, 3).is_point()) << "alpha";
    SampledTexture other = map.texture();
    other.view.texels = nullptr;
    EXPECT_TRUE(range_detail::decoded(other, 0, 0.5).is_point());
}

}  // namespace
}  // namespace quadrel::test
