// The slopes of all patches that a place may be in, against those at places of the range.
#include "effort.hpp"
#include "quadrel/relief/range_words.hpp"
#include "quadrel/texture/range/patch.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/stress_maps.hpp"

namespace quadrel::test {
namespace {

/// Value and slopes, a texel, by the formula.
struct PatchAt {
    double value, x, y;

    PatchAt(const SampledTexture& map, double u, double v) {
        const range_detail::LevelTexels level(map, 0);
        const double a = u * level.width() - 0.5, b = v * level.height() - 0.5;
        const double i = std::floor(a), j = std::floor(b), f = a - i, g = b - j;
        const auto h = [&](int across, int up) { return level.at(i + across, j + up).channel[0]; };
        value = (h(0, 0) * (1 - f) + h(1, 0) * f) * (1 - g) + (h(0, 1) * (1 - f) + h(1, 1) * f) * g;
        x = (h(1, 0) - h(0, 0)) * (1 - g) + (h(1, 1) - h(0, 1)) * g;
        y = (h(0, 1) - h(0, 0)) * (1 - f) + (h(1, 1) - h(1, 0)) * f;
    }
};

bool holds(const RealInterval& range, double value) {
    return value >= range.lo - 1e-9 && value <= range.hi + 1e-9;
}

/// Places up to `apart` texels around those that ranges of `claimed` are made for.
bool patch_slopes_are_held(double apart, double claimed, double& widths) {
    bool all = true;
    for (const StressMap& kind : stress_maps()) {
        Random random(static_cast<std::uint64_t>(kind.name[0]) + 1);
        const Map map = random_stress_map(random, kind, 24);
        const double texel = 1.0 / map.sampled.view.width[0],
                     row = 1.0 / map.sampled.view.height[0];
        for (int i = 0; i < rounds(20); ++i) {
            const double u = random.uniform(-1, 2), v = random.uniform(-1, 2);
            const auto around = [&](double x, double step) {
                return Ranged(x - claimed * step, x + claimed * step);
            };
            const auto patch =
                range_detail::patch_range(map.sampled, 0, around(u, texel), around(v, row));
            if (!std::isfinite(patch.value.width())) continue;
            widths += patch.x.width();
            for (int n = 0; n < 8; ++n) {
                const PatchAt one(map.sampled, u + random.uniform(-apart, apart) * texel,
                                  v + random.uniform(-apart, apart) * row);
                if (!std::isfinite(one.value)) continue;
                all &=
                    holds(patch.value, one.value) && holds(patch.x, one.x) && holds(patch.y, one.y);
            }
        }
    }
    return all;
}

TEST(PatchRanges, HoldSlopesAndHeights) {
    double near = 0, far = 0;
    EXPECT_TRUE(patch_slopes_are_held(1e-3, 1e-3, near));
    EXPECT_TRUE(patch_slopes_are_held(2, 2, far));
    EXPECT_LT(near, far / 4);
    EXPECT_FALSE(patch_slopes_are_held(1, 1e-3, near));
}

}  // namespace
}  // namespace quadrel::test
