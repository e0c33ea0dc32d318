// prism-pom: what prism-exact finds, up to a step.
#include "effort.hpp"
#include "relief/shell/prism_run.hpp"

namespace quadrel::test {
namespace {

/// Shares of the rays whose hit is not within `tolerance` of the exact one, in lengths of a step.
double share_off(int steps, double tolerance, const std::string& row = "prism-pom") {
    int rays = 0, off = 0;
    for (int i = 0; i < rounds(4); ++i) {
        PrismRun<double> run(static_cast<std::uint64_t>(i) + 300);
        run.search_exactly(PrismSurface::bilinear);
        std::vector<oracle::Real> exact;
        for (int lane = 0; lane < run.batch.lanes; ++lane) exact.push_back(run.found(lane));
        run.search(row, {{"steps", steps}, {"most", 65536}});
        const double step = run.batch.material.depth / steps;
        for (int lane = 0; lane < run.batch.lanes; ++lane) {
            const oracle::Real a = exact[static_cast<std::size_t>(lane)], b = run.found(lane);
            ++rays;
            off += a != b && !(std::fabs(a - b) <= tolerance * step);
        }
    }
    return static_cast<double>(off) / rays;
}

TEST(PrismPom, FindsWhatIsThickerThanAStep) {
    EXPECT_LT(share_off(2000, 1), 0.005);
    EXPECT_LT(share_off(200, 1), 0.05);
    EXPECT_GT(share_off(4, 0.01), 0.02) << "a chord is not exact";
}

/// A level is linear between samples.
TEST(PrismPom, LevelsAreMetExactly) {
    const Map map = flat_map(0.625f, 8);
    const auto maxima = bake(*map.texture, BakeKind::max_mip, map.sampled.sampler);
    const SampledTexture sampled_maxima{maxima->view(), map.sampled.sampler};
    int hits = 0;
    for (int i = 0; i < rounds(6); ++i) {
        PrismRun<double> run(static_cast<std::uint64_t>(i) + 500);
        run.batch.bind(TextureSlot::height, map.sampled);
        run.batch.bind(TextureSlot::max_mip, sampled_maxima);
        run.search_exactly(PrismSurface::bilinear);
        std::vector<oracle::Real> exact;
        for (int lane = 0; lane < run.batch.lanes; ++lane) exact.push_back(run.found(lane));
        run.search("prism-pom", {{"steps", 3}});
        for (int lane = 0; lane < run.batch.lanes; ++lane) {
            const oracle::Real a = exact[static_cast<std::size_t>(lane)], b = run.found(lane);
            hits += a < 1e9L;
            EXPECT_TRUE(a == b || std::fabs(a - b) < 1e-9L)
                << lane << ": " << double(b) << " for " << double(a);
        }
    }
    EXPECT_GT(hits, 100);
}

}  // namespace
}  // namespace quadrel::test
