// Bricks in running bond with mortar grooves: four bricks by eight courses a tile, at any point.
#include "brick_wall.hpp"

#include "colour.hpp"
#include "noise.hpp"
#include "shaping.hpp"

namespace quadrel::textures {
namespace {

// Lengths are in units of 1/512 of the tile, whatever the size of the map.
constexpr double tile = 512;
constexpr glm::dvec2 pitch(128, 64);  // a brick and its share of mortar
constexpr double mortar_width = 11, corner_radius = 9, rounding = 8;

/// What a point of the tile shows.
struct Spot {
    glm::dvec2 uv;
    int column, row;   ///< of the brick
    glm::dvec2 local;  ///< from the brick's centre
    double inside;     ///< distance to the brick's edge, negative in the mortar
    double profile;    ///< 0 mortar, 1 face of the brick, rounded between

    double vary(std::uint32_t seed) const { return random(column, row, seed); }
};

Spot find_spot(glm::dvec2 uv) {
    // Warping the plane makes the edges uneven.
    const glm::dvec2 warp(fractal_noise(uv, 12, 3, 1), fractal_noise(uv, 12, 3, 2));
    const glm::dvec2 p = uv * tile + 2.2 * warp;
    const int row = static_cast<int>(std::floor(p.y / pitch.y));
    const double x = p.x + (row & 1 ? 0.5 * pitch.x : 0);
    const int column = static_cast<int>(std::floor(x / pitch.x));
    const glm::dvec2 local(x - (column + 0.5) * pitch.x, p.y - (row + 0.5) * pitch.y);
    const double chips = 2.5 * smoothstep(0.25, 0.8, fractal_noise(uv, 26, 2, 3));
    const glm::dvec2 half_size = 0.5 * (pitch - glm::dvec2(mortar_width));
    const double inside = -rounded_rectangle(local, half_size, corner_radius) - chips;
    return {uv, (column + 4) % 4, (row + 8) % 8, local, inside, quarter_circle(inside / rounding)};
}

double height_at(const Spot& spot) {
    const double tilt =
        (spot.vary(11) - 0.5) * spot.local.x / 1100 + (spot.vary(12) - 0.5) * spot.local.y / 550;
    const double pits = smoothstep(0.45, 0.9, fractal_noise(spot.uv, 40, 2, 13));
    const double face = 0.86 + 0.10 * spot.vary(14) + tilt +
                        0.025 * fractal_noise(spot.uv, 24, 4, 15) - 0.06 * pits;
    const double mortar = 0.14 + 0.05 * fractal_noise(spot.uv, 32, 3, 16);
    return mix(mortar, face, spot.profile);
}

glm::dvec3 face_colour(const Spot& spot) {
    static const glm::dvec3 palette[] = {srgb(0xa4503a), srgb(0x8f3f2e), srgb(0xb5644a),
                                         srgb(0x7c3a30), srgb(0xa85b3c), srgb(0x96493c)};
    glm::dvec3 colour = palette[static_cast<int>(spot.vary(21) * 6)];
    colour *= 0.85 + 0.3 * spot.vary(22);
    colour *= 1 + 0.22 * fractal_noise(spot.uv, {6, 12}, 5, 23);
    const double soot = smoothstep(0.1, 0.9, fractal_noise(spot.uv, 5, 4, 24));
    colour = mix(colour, srgb(0x4b2c26), 0.55 * soot);
    const double bloom = smoothstep(0.25, 0.9, fractal_noise(spot.uv, {10, 7}, 5, 25));
    colour = mix(colour, srgb(0xcfa08a), 0.45 * bloom);
    const double specks = smoothstep(0.5, 0.8, fractal_noise(spot.uv, 90, 1, 26));
    return mix(colour, srgb(0x3a2622), 0.6 * specks);
}

glm::dvec4 colour_at(const Spot& spot) {
    const double grain = fractal_noise(spot.uv, 64, 3, 31);
    glm::dvec3 mortar = mix(srgb(0x9d958a), srgb(0x6f675f), 0.5 + 0.5 * grain);
    mortar *= 0.8 + 0.2 * smoothstep(-6, 0, -spot.inside);
    const double edge = 0.82 + 0.18 * smoothstep(0, 7, spot.inside);
    const double blend = smoothstep(-0.5, 2.5, spot.inside + 0.8 * grain);
    return {mix(mortar, face_colour(spot) * edge, blend), 1};
}

/// Shininess / 255, relative index of refraction / 2, mirror.
glm::dvec3 gloss_at(const Spot& spot) {
    const double fired = saturate(0.5 + 0.5 * fractal_noise(spot.uv, 7, 3, 41));
    return {mix(4.0, 10 + 26 * fired * spot.vary(42), spot.profile) / 255, 1 / 1.5 / 2, 0};
}

}  // namespace

double wall_height(const glm::dvec2& uv) { return height_at(find_spot(uv)); }

glm::dvec4 wall_colour(const glm::dvec2& uv) { return colour_at(find_spot(uv)); }

glm::dvec3 wall_gloss(const glm::dvec2& uv) { return gloss_at(find_spot(uv)); }

}  // namespace quadrel::textures
