// Height maps on which searches go wrong, each at any size; and rays at every angle.
#pragma once

#include "quadrel/num/math.hpp"
#include "relief/inputs.hpp"

namespace quadrel::test {

/// Heights of a map by texel; `n` is the longer side.
struct StressMap {
    const char* name;
    std::function<float(int x, int y, int n, Random& random)> height;
};

/// Value noise of four octaves, bilinear between the lattice's points, rounded to 16 bits.
inline float fractal_height(int x, int y, int n) {
    double sum = 0;
    for (int octave = 0; octave < 4; ++octave) {
        const int cells = 2 << octave;
        const double px = double(x) * cells / n, py = double(y) * cells / n;
        const auto lattice = [&](int i, int j) {
            const int at = ((octave * 64 + i % cells) * 64 + j % cells);
            return Random(static_cast<std::uint64_t>(at)).uniform(0, 1);
        };
        const int i = static_cast<int>(px), j = static_cast<int>(py);
        const double f = px - i, g = py - j;
        const double low = lattice(i, j) * (1 - f) + lattice(i + 1, j) * f;
        const double high = lattice(i, j + 1) * (1 - f) + lattice(i + 1, j + 1) * f;
        sum += (low * (1 - g) + high * g) / (2 << octave);
    }
    return static_cast<float>(std::floor(sum / 0.9375 * 65535)) / 65535;
}

inline const std::vector<StressMap>& stress_maps() {
    const auto mark = [](bool high) { return high ? 1.0f : 0.0f; };
    static const std::vector<StressMap> maps{
        {"flat", [](int, int, int, Random&) { return 0.5f; }},
        {"bottom", [](int, int, int, Random&) { return 0.0f; }},
        {"ramp", [](int x, int y, int n, Random&) { return float(x + 2 * y) / float(3 * n); }},
        {"impulse", [=](int x, int y, int n, Random&) { return mark(x == n / 2 && y == n / 3); }},
        {"spikes", [=](int, int, int, Random& r) { return mark(r.chance(0.02)); }},
        {"wall x", [=](int x, int, int, Random&) { return mark(x % 16 == 8); }},
        {"wall y", [=](int, int y, int, Random&) { return mark(y % 16 == 8); }},
        {"wall diagonal", [=](int x, int y, int, Random&) { return mark((x + y) % 16 == 8); }},
        {"comb", [=](int x, int, int, Random&) { return mark(x % 2 == 0); }},
        {"checker", [=](int x, int y, int, Random&) { return mark((x + y) % 2 == 0); }},
        {"checker of 8",
         [=](int x, int y, int, Random&) { return mark((x / 8 + y / 8) % 2 == 0); }},
        {"cliff", [=](int x, int, int n, Random&) { return mark(2 * x < n); }},
        {"strokes",
         [=](int x, int y, int, Random&) {
             return mark((x % 12 < 2 && y % 16 < 12) || (y % 16 < 2 && x % 12 < 9));
         }},
        {"steps",
         [](int x, int y, int n, Random&) {
             return float(std::min(std::min(x, y), std::min(n - x, n - y)) * 8 / n) / 4;
         }},
        {"sinusoid",
         [](int x, int y, int n, Random&) {
             const double turn = 6.283185307179586 / n;
             return float(0.5 + 0.25 * sin(3 * x * turn) + 0.25 * sin(5 * y * turn));
         }},
        {"white noise", [](int, int, int, Random& r) { return float(r.below(256)) / 255; }},
        {"fractal", [](int x, int y, int n, Random&) { return fractal_height(x, y, n); }},
    };
    return maps;
}

/// A stress map of the given size; sizes need not be powers of two.
inline Map make_stress_map(const StressMap& kind, int width, int height,
                           const SamplerState& sampler, Random& random) {
    const int n = std::max(width, height);
    return make_map(
        width, height, 1, [&](int x, int y, int) { return kind.height(x, y, n, random); }, sampler);
}

/// K of a relief of `depth` tiles seen at an angle up to 89.9 degrees. A quarter of the azimuths
/// are multiples of 45 degrees.
inline vec2<float> random_shift(Random& random, double depth = 0.1) {
    const double theta = random.chance(0.1) ? 0.0 : random.uniform(0, 89.9) * 0.017453292519943295;
    const double azimuth = random.chance(0.25) ? random.below(8) * 0.7853981633974483
                                               : random.uniform(0, 6.283185307179586);
    const double shift = depth * sin(theta) / cos(theta);
    return vec2<float>(vec2<double>(shift * cos(azimuth), shift * sin(azimuth)));
}

/// Some rays start on centres and borders of texels, and run along them or through corners.
inline void fill_stress_rays(Batch<float>& batch, const Map& map, Random& random) {
    const TextureView& view = map.sampled.view;
    for (int lane = 0; lane < batch.lanes; ++lane) {
        const bool special = random.chance(0.2);
        vec2<float> K = random_shift(random);
        for (int c = 0; c < 2; ++c) {
            const int size = c == 0 ? view.width[0] : view.height[0];
            const double on_grid = random.below(4 * size) / (2.0 * size) - 0.5;
            const double uv = special ? on_grid : random.uniform(-2, 2);
            batch.real(Value::uv, lane, c) = static_cast<float>(uv);
        }
        if (special) {
            const int cells = random.below(40) - 20, other = random.below(3) - 1;
            K = {float(cells) / float(view.width[0]), float(cells * other) / float(view.height[0])};
        }
        batch.set(Value::K, lane, K);
        batch.set(Value::dUVdx, lane, dvec2(0.001, 0));
        batch.set(Value::dUVdy, lane, dvec2(0, 0.001));
        batch.integer(Value::frame_status, lane) = static_cast<int>(Status::hit);
        batch.integer(Value::frame_flags, lane) = 0;
    }
    batch.material.depth = 0.1f;
}

}  // namespace quadrel::test
