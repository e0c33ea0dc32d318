// Quadtree displacement mapping against a transcription of FlightGear's Shaders/urban.frag,
// function names in comments.
#include "quadrel/texture/height_sampler.hpp"
#include "relief/exact/exact_search.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

struct Listed {
    float x, y, z;
    bool capped;
};

/// The map as the listing has it: a pyramid of least depths, and the depths themselves, filtered.
class QdmMaps {
  public:
    QdmMaps(const SampledTexture& height, const TextureView& pyramid)
        : levels(pyramid.levels),
          heights_(height, lod_from_level(height, Quad<float>(0))),
          pyramid_(pyramid) {}

    // texture2DLod(QDMTex, uv, level).a
    float depth(vec2<float> uv, int level) const {
        const int n = pyramid_.width[level];
        const auto at = [n](float u) { return to_int((u - std::floor(u)) * float(n)) % n; };
        return 1 - pyramid_.texels[pyramid_.offset[level] + at(uv.y) * n + at(uv.x)];
    }
    // texture2DLod(NormalTex, uv, 0.0).a
    float filtered(vec2<float> uv) const {
        return 1 - heights_({}, {Quad<float>(uv.x), Quad<float>(uv.y)}).lane[0];
    }

    int levels;

  private:
    GeneralHeight<Quad<float>> heights_;
    const TextureView& pyramid_;
};

float listed_sign(float x) { return x > 0 ? 1.0f : x < 0 ? -1.0f : 0.0f; }
float listed_min(float a, float b) { return b < a ? b : a; }

Listed listing(const QdmMaps& maps, vec2<float> uv0, vec2<float> ds, float depth_factor, int texels,
               Planted planted) {
    const int L = maps.levels - 1;                               // MAX_LEVEL
    const vec2<float> dp(uv0.x + ds.x * -1, uv0.y + ds.y * -1);  // vec2 dp = uv - ds
    const float e = 0.5f / float(texels);                        // texel half
    const float dN = e * depth_factor;                           // delta
    // QDM(): p = (dp, 0), v = (ds, 1), p2 = p
    float px = dp.x, py = dp.y, pz = 0, d = 0;
    const float sx = (listed_sign(ds.x) + 1) * 0.5f, sy = (listed_sign(ds.y) + 1) * 0.5f;
    int level = L, it = 0;
    while (level >= 0 && it < 64) {
        d = maps.depth({px, py}, level);
        if (d > pz) {
            const float nc = std::ldexp(1.0f, L - level);  // pow(2, MAX_LEVEL - level)
            const float qx = dp.x + ds.x * d, qy = dp.y + ds.y * d;
            const float ax = std::floor(px * nc), ay = std::floor(py * nc);
            if (ax != std::floor(qx * nc) || ay != std::floor(qy * nc)) {
                const float Ax = px - dp.x, Ay = py - dp.y;
                const float Bx = (ax + sx) / nc - dp.x, By = (ay + sy) / nc - dp.y;
                const float dnx = Bx * pz / Ax, dny = By * pz / Ay;
                d = listed_min(d, listed_min(dnx, dny)) + (planted == Planted::none ? dN : 2 * dN);
                level += 1;
            }
            px = dp.x + ds.x * d, py = dp.y + ds.y * d, pz = d;
        }
        level -= 1;
        it += 1;
    }
    // Smoothing between two points.
    const float wx = px - dp.x, wy = py - dp.y;
    const float R = std::sqrt(wx * wx + wy * wy) + dN;
    const float dA = pz * (R - 2 * e) / R, dB = pz * (R + 2 * e) / R;
    const float xa = dp.x + ds.x * dA, ya = dp.y + ds.y * dA;
    const float xb = dp.x + ds.x * dB, yb = dp.y + ds.y * dB;
    const float eA = std::fabs(dA - maps.filtered({xa, ya}));
    const float eB = std::fabs(dB - maps.filtered({xb, yb}));
    const float t = eA / (eA + eB);
    const auto blend = [t](float a, float b) { return a * (1 - t) + b * t; };
    return {blend(xa, xb), blend(ya, yb), blend(dA, dB), level >= 0};
}

testing::AssertionResult equals_listing(Planted planted) {
    for (int i = 0; i < 40; ++i) {
        Random random(static_cast<std::uint64_t>(i));
        const int size = 4 << random.below(5);
        const auto& kinds = stress_maps();
        const ExactMaps maps(make_stress_map(kinds[std::size_t(random.below(int(kinds.size())))],
                                             size, size, plain_sampler(), random));
        Batch<float> rays(64);
        fill_stress_rays(rays, maps.height, random);
        rays.material.seat = 0;
        for (int lane = 0; lane < rays.lanes; ++lane)
            for (int c = 0; c < 6; ++c) rays.real(Value::J, lane, c) = c == 0 ? 1.0f : 0.0f;
        maps.bind(rays);
        rays.run("qdm@published");
        const QdmMaps listed(maps.height.sampled,
                             maps.baked[std::size_t(TextureSlot::texel_max)].sampled.view);
        for (int lane = 0; lane < rays.lanes; ++lane) {
            const Listed hit = listing(listed, rays.vector2(Value::uv, lane),
                                       rays.vector2(Value::K, lane), 0.1f, size, planted);
            const float found[] = {rays.real(Value::hit_uv, lane, 0),
                                   rays.real(Value::hit_uv, lane, 1),
                                   rays.real(Value::hit_s, lane)};
            const float expected[] = {hit.x, hit.y, hit.z};
            const bool capped = rays.integer(Value::hit_status, lane) == int(Status::cap);
            for (int c = 0; c < 3; ++c) {
                const bool same =
                    found[c] == expected[c] || (found[c] != found[c] && expected[c] != expected[c]);
                if (!same || capped != hit.capped) {
                    return testing::AssertionFailure() << "batch " << i << " lane " << lane << ": "
                                                       << found[c] << " for " << expected[c];
                }
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(QdmPublished, EqualsListing) {
    EXPECT_TRUE(equals_listing(Planted::none));
    EXPECT_FALSE(equals_listing(Planted::late_border));
}

}  // namespace
}  // namespace quadrel::test
