// Sand dunes: asymmetric ridges that bend, smaller ones across them, and wind ripples.
#include "colour.hpp"
#include "noise.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

/// A ridge of period 1: a long windward slope up, a short slip face down, the crest at 0.68.
double ridge(double phase) {
    const double x = phase - std::floor(phase);
    const double t = x < 0.68 ? x / 0.68 : (1 - x) / 0.32;
    return mix(t, t * t * (3 - 2 * t), 0.7);
}

/// A smooth wave of period 1 in [0, 1].
double wave(double phase) {
    const double t = std::fabs(2 * (phase - std::floor(phase)) - 1);
    return t * t * (3 - 2 * t);
}

struct Dune {
    double large, small, ripples;
};

Dune dune_at(glm::dvec2 uv) {
    const double bend = fractal_noise(uv, 2, 3, 301), sway = fractal_noise(uv, 4, 3, 302);
    const double large = ridge(3 * uv.y + uv.x + 0.55 * bend) * (0.75 + 0.25 * sway);
    const double small = ridge(7 * uv.y - 3 * uv.x + 0.8 * bend + 0.35 * sway);
    const double ripples = wave(44 * uv.y + 14 * uv.x + 2.5 * bend + 1.2 * sway);
    return {large, small, ripples};
}

double height_at(glm::dvec2 uv) {
    const Dune dune = dune_at(uv);
    return 0.03 + 0.70 * dune.large + 0.20 * dune.small * (0.4 + 0.6 * dune.large) +
           0.006 * dune.ripples;
}

glm::dvec4 colour_at(glm::dvec2 uv) {
    const Dune dune = dune_at(uv);
    const double grain = fractal_noise(uv, 128, 1, 311), patches = fractal_noise(uv, 6, 4, 312);
    const double light = saturate(0.15 + 0.65 * dune.large + 0.2 * patches);
    glm::dvec3 colour = mix(srgb(0xb07c45), srgb(0xe8c88c), light);
    colour *= 1 + 0.06 * grain - 0.09 * dune.ripples;
    return {colour, 1};
}

template <class T, class Function>
Grid<T> map_of(int size, Function value) {
    return make_grid<T>(size, size, [&](int x, int y) {
        return value(glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size));
    });
}

}  // namespace

void write_dunes(const std::filesystem::path& directory) {
    write_height(directory / "dunes_height.exr", map_of<double>(512, height_at));
    write_colour(directory / "dunes_color.exr", map_of<glm::dvec4>(512, colour_at));
}

}  // namespace quadrel::textures
