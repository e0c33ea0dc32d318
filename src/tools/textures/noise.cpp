#include "noise.hpp"

#include <cmath>

#include "shaping.hpp"

namespace quadrel::textures {
namespace {

/// Wellons' lowbias32: every input bit changes every output bit about half of the time.
std::uint32_t scramble(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

std::uint32_t hash(int x, int y, std::uint32_t seed) {
    return scramble(static_cast<std::uint32_t>(x) +
                    scramble(static_cast<std::uint32_t>(y) + scramble(seed + 0x9e3779b9u)));
}

int wrap(int i, int period) { return ((i % period) + period) % period; }

/// The contribution of one lattice point: its gradient times the offset from it.
double corner(glm::ivec2 lattice, glm::dvec2 offset, glm::ivec2 period, std::uint32_t seed) {
    static constexpr double diagonal = 0.70710678118654752;
    static constexpr double directions[8][2] = {
        {1, 0},  {diagonal, diagonal},   {0, 1},  {-diagonal, diagonal},
        {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}};
    const auto& d =
        directions[hash(wrap(lattice.x, period.x), wrap(lattice.y, period.y), seed) >> 29];
    return d[0] * offset.x + d[1] * offset.y;
}

double quintic(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

double random(int x, int y, std::uint32_t seed) { return hash(x, y, seed) / 4294967296.0; }

double gradient_noise(glm::dvec2 p, glm::ivec2 period, std::uint32_t seed) {
    const glm::ivec2 i(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)));
    const glm::dvec2 f(p.x - i.x, p.y - i.y);
    const double a = corner(i, f, period, seed);
    const double b = corner({i.x + 1, i.y}, {f.x - 1, f.y}, period, seed);
    const double c = corner({i.x, i.y + 1}, {f.x, f.y - 1}, period, seed);
    const double d = corner({i.x + 1, i.y + 1}, {f.x - 1, f.y - 1}, period, seed);
    const double s = quintic(f.x), t = quintic(f.y);
    return mix(mix(a, b, s), mix(c, d, s), t);
}

double fractal_noise(glm::dvec2 uv, glm::ivec2 frequency, int octaves, std::uint32_t seed) {
    double sum = 0, amplitude = 1.1;
    for (int octave = 0; octave < octaves; ++octave) {
        const glm::dvec2 p(uv.x * frequency.x, uv.y * frequency.y);
        sum += amplitude * gradient_noise(p, frequency, seed + static_cast<std::uint32_t>(octave));
        amplitude *= 0.5;
        frequency *= 2;
    }
    return sum;
}

}  // namespace quadrel::textures
