// Tileable noise from integer hashes: the same values on every machine.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace quadrel::textures {

/// A number in [0, 1), a function of the lattice point and the seed alone.
double random(int x, int y, std::uint32_t seed);

/// Gradient noise (Perlin, "Improving Noise", 2002) at p, with period `period` in both axes;
/// within [-1, 1], zero on lattice points.
double gradient_noise(glm::dvec2 p, glm::ivec2 period, std::uint32_t seed);

/// Sum of octaves of gradient noise, each of twice the frequency and half the amplitude, scaled to
/// fill about [-1, 1]. `uv` in units of the tile; `frequency` lattice cells a tile in each axis.
double fractal_noise(glm::dvec2 uv, glm::ivec2 frequency, int octaves, std::uint32_t seed);
inline double fractal_noise(glm::dvec2 uv, int frequency, int octaves, std::uint32_t seed) {
    return fractal_noise(uv, glm::ivec2(frequency, frequency), octaves, seed);
}

}  // namespace quadrel::textures
