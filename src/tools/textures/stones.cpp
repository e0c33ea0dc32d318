// Cobbles: the cells of a Voronoi diagram with rounded corners, domed, with soil and moss between.
#include "colour.hpp"
#include "noise.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

constexpr int cells = 7;                    // stones along a side of the tile
constexpr double gap = 0.055, dome = 0.36;  // in cells

int wrap_cell(int i) { return ((i % cells) + cells) % cells; }

/// The centre of a stone, in cells.
glm::dvec2 site(glm::ivec2 cell) {
    const int x = wrap_cell(cell.x), y = wrap_cell(cell.y);
    return {cell.x + 0.5 + 0.62 * (random(x, y, 101) - 0.5),
            cell.y + 0.5 + 0.62 * (random(x, y, 102) - 0.5)};
}

struct Spot {
    glm::dvec2 uv;
    glm::ivec2 stone;
    glm::dvec2 local;  ///< from the stone's centre, in cells
    double inside;     ///< distance to the stone's edge in cells, negative in the gap
    double profile;    ///< 0 in the gap, 1 on top of the dome

    double vary(std::uint32_t seed) const {
        return random(wrap_cell(stone.x), wrap_cell(stone.y), seed);
    }
};

template <class Visit>
void for_neighbours(glm::ivec2 centre, Visit visit) {
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) visit(centre + glm::ivec2(x, y));
}

glm::ivec2 nearest_stone(glm::dvec2 p) {
    const glm::ivec2 home(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)));
    glm::ivec2 best = home;
    double least = 1e9;
    for_neighbours(home, [&](glm::ivec2 cell) {
        const double distance = length(site(cell) - p);
        if (distance < least) least = distance, best = cell;
    });
    return best;
}

/// Distance from p to the nearest side of the stone's cell, corners rounded off.
double distance_to_border(glm::dvec2 p, glm::ivec2 stone) {
    const glm::dvec2 centre = site(stone);
    double least = 1;
    for_neighbours(stone, [&](glm::ivec2 cell) {
        if (cell == stone) return;
        const glm::dvec2 other = site(cell), across = other - centre;
        const double distance = dot(0.5 * (centre + other) - p, across) / length(across);
        least = smooth_min(least, distance, 0.16);
    });
    return least;
}

Spot find_spot(glm::dvec2 uv) {
    const glm::dvec2 warp(fractal_noise(uv, 14, 3, 111), fractal_noise(uv, 14, 3, 112));
    const glm::dvec2 p = uv * static_cast<double>(cells) + 0.05 * warp;
    const glm::ivec2 stone = nearest_stone(p);
    const double inside = distance_to_border(p, stone) - gap;
    const double profile = quarter_circle(quarter_circle(inside / dome) * 0.86 + 0.02);
    return {uv, stone, p - site(stone), inside, inside > 0 ? profile : 0};
}

double height_at(const Spot& spot) {
    const double tilt =
        0.12 * ((spot.vary(121) - 0.5) * spot.local.x + (spot.vary(122) - 0.5) * spot.local.y);
    const double top =
        0.80 + 0.14 * spot.vary(123) + tilt + 0.018 * fractal_noise(spot.uv, 16, 4, 124);
    const double soil = 0.10 + 0.07 * fractal_noise(spot.uv, 40, 3, 125);
    return mix(soil, top, spot.profile);
}

glm::dvec3 stone_colour(const Spot& spot) {
    static const glm::dvec3 palette[] = {srgb(0x8b8a86), srgb(0x70747a), srgb(0x9c9182),
                                         srgb(0x7b6f66), srgb(0x626567), srgb(0xa69b8c),
                                         srgb(0x7b8288)};
    glm::dvec3 colour = palette[static_cast<int>(spot.vary(131) * 7)];
    colour *= 0.8 + 0.35 * spot.vary(132);
    colour *= 1 + 0.25 * fractal_noise(spot.uv, 10, 5, 133 + spot.stone.x % 3);
    const double vein = std::fabs(fractal_noise(spot.uv, {9, 5}, 4, 141));
    const double veined = spot.vary(143) < 0.3 ? 0.45 : 0.08;
    colour = mix(srgb(0xcfc8bb), colour, 1 - veined * (1 - smoothstep(0, 0.06, vein)));
    const double grain = fractal_noise(spot.uv, 120, 1, 142);
    return colour * (1 + 0.18 * grain);
}

glm::dvec4 colour_at(const Spot& spot) {
    const double grain = 0.5 + 0.5 * fractal_noise(spot.uv, 60, 3, 151);
    const double moss = smoothstep(-0.1, 0.5, fractal_noise(spot.uv, 5, 4, 152));
    const glm::dvec3 soil = mix(srgb(0x2b231c), srgb(0x5a4a3a), saturate(grain));
    const glm::dvec3 green = mix(srgb(0x2c3a16), srgb(0x66752e), saturate(grain));
    const double creep = 0.035 * moss;  // moss climbs the sides of the stones
    const double blend = smoothstep(-0.005, 0.03, spot.inside - creep * (0.4 + grain));
    const double edge = 0.6 + 0.4 * smoothstep(0, 0.14, spot.inside);
    return {mix(mix(soil, green, moss), stone_colour(spot) * edge, blend), 1};
}

/// Wet stones: shininess / 255, relative index of refraction / 2, mirror.
glm::dvec3 gloss_at(const Spot& spot) {
    const double wet = saturate(0.55 + 0.6 * fractal_noise(spot.uv, 4, 3, 161));
    const double on_stone = smoothstep(0.02, 0.1, spot.inside);
    return {(6 + on_stone * (24 + 80 * wet)) / 255, 1 / 1.33 / 2, on_stone * 0.10 * wet};
}

template <class T, class Function>
Grid<T> map_of(int size, Function value) {
    return make_grid<T>(size, size, [&](int x, int y) {
        return value(find_spot(glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size)));
    });
}

}  // namespace

void write_stones(const std::filesystem::path& directory) {
    write_height(directory / "stones_height.exr", map_of<double>(512, height_at));
    write_colour(directory / "stones_color.exr", map_of<glm::dvec4>(512, colour_at));
    write_data(directory / "stones_gloss.exr", map_of<glm::dvec3>(256, gloss_at));
}

}  // namespace quadrel::textures
