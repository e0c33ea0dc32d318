// What is said of the solids that all rays of a range meet, and of lights behind them, against the
// judge's word on rays of it.
#include "effort.hpp"
#include "quadrel/relief/range_words.hpp"
#include "quadrel/relief/shadow/range_layers.hpp"
#include "relief/layer/layer_oracle.hpp"
#include "relief/oracle/judged.hpp"

namespace quadrel::test {
namespace {

using range_detail::FirstParts;
using range_detail::LayerHits;
using range_detail::RisingRays;
using range_detail::RisingThroughLayers;

struct LayerPartsFound {
    int ranges = 0, known = 0;
    double width = 0;  ///< of all parts together, summed
};

/// Rays up to `apart` from those over every kind of layers, asked for as if they were no further
/// apart than `claimed`.
testing::AssertionResult layer_hits_are_held(double apart, double claimed, LayerPartsFound& found) {
    for (const LayerKind& kind : layer_kinds()) {
        Random random(static_cast<std::uint64_t>(kind.name[0]) + 3);
        const LayerMaps maps = random_layer_maps(random, kind);
        Batch<float> rays(rounds(8) * 4);
        fill_stress_rays(rays, maps.layers, random);
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const int pairs = 1 + lane % 2;
            const oracle::LayerField field(maps.layers.sampled, 2 * pairs);
            const judge::Ray ray = judged_ray(rays, lane);
            const LayerHits hits(maps.layers.sampled, pairs, about(ray, claimed));
            ++found.ranges;
            if (!hits.places().are_short()) continue;
            const FirstParts parts(hits, hits.places().shortest());
            if (!parts.known()) continue;
            ++found.known;
            for (int k = 0; k < parts.count(); ++k) found.width += parts[k].width();
            for (int i = 0; i < 6; ++i) {
                const auto hit = oracle::meet_layers<oracle::Real>(
                    field, long_ray(one_of(about(ray, apart), random)));
                bool held = !hit.found() && parts.passes();
                for (int k = 0; k < parts.count(); ++k)
                    held |= hit.s >= parts[k].lo - 1e-9L && hit.s <= parts[k].hi + 1e-9L;
                if (!held)
                    return testing::AssertionFailure()
                           << kind.name << ", ray " << lane << ": " << double(hit.s)
                           << " in none of " << parts.count();
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(LayerRanges, HoldTheHitsOfEachRay) {
    for (const double apart : {1e-9, 1e-4, 1e-2}) {
        LayerPartsFound found;
        EXPECT_TRUE(layer_hits_are_held(apart, apart, found)) << apart;
        EXPECT_GT(found.known, found.ranges / 2) << apart;
        if (apart == 1e-9) {
            EXPECT_LT(found.width / found.known, 0.02);
        }
    }
    LayerPartsFound found;
    EXPECT_FALSE(layer_hits_are_held(1e-2, 1e-4, found));
}

/// The layers on a ray upwards, and how far it is inside of a solid.
struct RisingJudge {
    const oracle::LayerField& field;
    dvec2 uv, K;
    double start;

    double inside(double t) const {
        const dvec2 at = uv + K * t;
        double most = -1;
        for (int layer = 0; layer < field.layers(); layer += 2) {
            const auto depth = [&](int of) {
                const oracle::Field& map = field.layer(of);
                return static_cast<double>(
                    map.bilinear(at.x * map.width - 0.5L, at.y * map.height - 0.5L));
            };
            const double s = start - t;
            most = std::max(most, std::min(s - depth(layer), depth(layer + 1) - s));
        }
        return most;
    }
    /// Whether that is ever more than `margin`.
    bool is_dark(double margin) const {
        for (int k = 1; k < samples; ++k)
            if (inside(start * k / samples) > margin) return true;
        return false;
    }
    static constexpr int samples = 2000;
};

struct LightsFound {
    int lit = 0, dark = 0, either = 0;
};

/// Lights from random layers over every kind of them; `turned`: towards the other side than asked.
testing::AssertionResult layer_lights_are_right(LightsFound& found, bool turned = false) {
    for (const LayerKind& kind : layer_kinds()) {
        Random random(static_cast<std::uint64_t>(kind.name[0]) + 11);
        const LayerMaps maps = layer_maps(kind.name, 5);
        const oracle::LayerField field(maps.layers.sampled, 4);
        for (int i = 0; i < rounds(60); ++i) {
            const dvec2 uv(random.uniform(0, 1), random.uniform(0, 1));
            const dvec2 K(random.uniform(-1, 1), random.uniform(-1, 1));
            const oracle::Field& own = field.layer(random.below(4));
            const auto start = static_cast<double>(
                own.bilinear(uv.x * own.width - 0.5L, uv.y * own.height - 0.5L));
            const auto around = [](double x) { return RealInterval(x - 1e-7, x + 1e-7); };
            const double side = turned ? -1 : 1;
            RisingThroughLayers rays(maps.layers.sampled, {around(uv.x), around(uv.y)},
                                     {around(side * K.x), around(side * K.y)}, around(start));
            const RisingRays::Answer answer = rays.answer();
            (answer == RisingRays::lit    ? found.lit
             : answer == RisingRays::dark ? found.dark
                                          : found.either) += 1;
            const RisingJudge judge{field, uv, K, start};
            const bool wrong = answer == RisingRays::lit    ? judge.is_dark(1e-4)
                               : answer == RisingRays::dark ? !judge.is_dark(-1e-9)
                                                            : false;
            if (wrong)
                return testing::AssertionFailure()
                       << kind.name << " " << i << ": " << static_cast<int>(answer);
        }
    }
    return testing::AssertionSuccess();
}

TEST(LayerRanges, KnowWhichLightsAreHidden) {
    LightsFound found;
    EXPECT_TRUE(layer_lights_are_right(found));
    EXPECT_GT(found.lit, 0);
    EXPECT_GT(found.dark, 0);
    // Where front and back are equal, either is what the ray starts on.
    EXPECT_LT(found.either, found.lit + found.dark);
    EXPECT_FALSE(layer_lights_are_right(found, true));
}

}  // namespace
}  // namespace quadrel::test
