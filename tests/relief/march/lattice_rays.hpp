// Rays as neighbouring pixels have them, over maps on which bounds go wrong, and the maxima of such
// maps with errors planted.
#pragma once

#include "bake/pyramid/height_maxima.hpp"
#include "relief/stress_maps.hpp"

namespace quadrel::test {

/// Maps beside stress_maps: heights outside of [0, 1], and none at all.
inline std::vector<StressMap> wild_maps() {
    std::vector<StressMap> maps = stress_maps();
    maps.push_back({"broken", [](int, int, int, Random& r) {
                        return r.chance(0.01) ? std::nanf("") : float(r.uniform(0, 0.6));
                    }});
    maps.push_back({"outside", [](int, int, int, Random& r) {
                        return float(r.chance(0.03) ? r.uniform(-3, 3) : r.uniform(-0.2, 0.4));
                    }});
    maps.push_back({"deep", [](int, int, int, Random& r) {
                        return float(r.chance(0.05) ? r.uniform(0.5, 1) : r.uniform(-1000, -900));
                    }});
    maps.push_back({"low", [](int, int, int, Random& r) { return float(r.uniform(0, 0.1)); }});
    return maps;
}

/// Sides of 1 to 70 texels, powers of two among them, under any wrap modes and filters.
inline Map make_wild_map(const StressMap& kind, Random& random) {
    const auto side = [&] {
        return random.chance(0.3) ? 1 << random.below(7) : 1 + random.below(70);
    };
    SamplerState sampler = random_sampler(random);
    sampler.weight_bits = random.chance(0.2) ? 8 : 0;
    sampler.border[0] = float(random.below(3)) / 2;
    const int width = side(), height = side();
    return make_stress_map(kind, width, height, sampler, random);
}

/// Packets of nearly parallel rays, each a pixel from the next, at up to 89.9 degrees; a pixel
/// spans a tenth of a texel to a few. Some lanes have no number, or do not search.
inline void fill_neighbouring_rays(Batch<float>& batch, const Map& map, Random& random) {
    vec2<double> uv, pixel;
    vec2<float> K;
    double r = 1;
    const double texels = std::max(map.sampled.view.width[0], map.sampled.view.height[0]);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        if (lane % 16 == 0) {
            uv = {random.uniform(-2, 2), random.uniform(-2, 2)};
            pixel = vec2<double>(random.uniform(-1, 1), random.uniform(-1, 1)) *
                    (random.uniform(0.1, 3) / texels);
            K = random_shift(random);
            r = random.uniform(0, 1);
        }
        const double x = lane / 4 % 4 * 2 + lane % 2, y = lane % 4 / 2;
        batch.set(Value::uv, lane,
                  uv + vec2<double>(pixel.x * x - pixel.y * y, pixel.y * x + pixel.x * y));
        batch.set(Value::K, lane, K * float(1 + random.uniform(-1e-3, 1e-3)));
        batch.real(Value::r, lane) = float(r + 1e-3 * x);
        batch.set(Value::dUVdx, lane, pixel);
        batch.set(Value::dUVdy, lane, vec2<double>(-pixel.y, pixel.x));
        const bool framed = !random.chance(0.02);
        batch.integer(Value::frame_status, lane) =
            static_cast<int>(framed ? Status::hit : Status::no_frame);
        batch.integer(Value::frame_flags, lane) = 0;
        batch.active[static_cast<std::size_t>(lane)] = !random.chance(0.02);
        if (random.chance(0.003)) batch.real(Value::uv, lane, 0) = std::nanf("");
        if (random.chance(0.003)) batch.real(Value::K, lane, 1) = 1e30f;
    }
    batch.material.depth = 0.1f;
    batch.material.seat = float(random.below(3)) / 2;
}

/// Hits of those rays, and a light that stands at any height over them. The relief lies in the
/// plane z = -1 of eye space.
inline void light_hits(Batch<float>& batch, Random& random) {
    batch.run("linear", {{"steps", 40}});
    const double azimuth = random.uniform(0, 6.3), elevation = random.uniform(-0.1, 1.57);
    const dvec3 L(cos(azimuth) * cos(elevation), sin(azimuth) * cos(elevation), sin(elevation));
    batch.frame.lights[0].directional = random.chance(0.5);
    const double distance = batch.frame.lights[0].directional ? 1 : 5;
    for (int c = 0; c < 3; ++c)
        batch.frame.lights[0].position[c] = static_cast<float>(L[c] * distance);
    for (int lane = 0; lane < batch.lanes; ++lane) {
        batch.set(Value::frame_normal, lane, dvec3(0, 0, 1));
        for (int c = 0; c < 6; ++c) batch.real(Value::J, lane, c) = c == 0 || c == 4 ? 1 : 0;
        batch.set(
            Value::hit_P, lane,
            dvec3(batch.real(Value::hit_uv, lane, 0), batch.real(Value::hit_uv, lane, 1), -1));
    }
}

/// Maxima that may be written to.
class DamagedMaxima {
  public:
    explicit DamagedMaxima(const HeightMaxima& from) : maxima(from) {
        for (int level = 0; level < from.levels; ++level) {
            TextureView& nodes = maxima.level[level].nodes;
            nodes_.emplace_back(nodes.texels, nodes.texels + nodes.offset[nodes.levels - 1] + 1);
            nodes.texels = nodes_.back().data();
        }
    }
    DamagedMaxima(const DamagedMaxima&) = delete;

    /// All nodes of a mip level, the finest first.
    std::vector<float>& nodes(int level) { return nodes_[static_cast<std::size_t>(level)]; }

    /// Makes slopes out to be only a part of what they are.
    void flatten(float part) {
        for (int level = 0; level < maxima.levels; ++level) {
            TextureView& slopes = maxima.level[level].slopes;
            slopes_.emplace_back(
                slopes.texels, slopes.texels + std::ptrdiff_t(slopes.width[0]) * slopes.height[0]);
            for (float& slope : slopes_.back()) slope *= part;
            slopes.texels = slopes_.back().data();
        }
    }

    HeightMaxima maxima;

  private:
    std::vector<std::vector<float>> nodes_, slopes_;
};

}  // namespace quadrel::test
