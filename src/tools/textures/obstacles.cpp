// One small map with everything that a search may stumble over: a smooth dome, a pyramid of steps,
// walls of one texel in three directions, a comb, spikes, and hills between.
#include "colour.hpp"
#include "noise.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

constexpr int size = 128;
constexpr double tile_depth = 0.05;  // of the normal map: depth over the tile's side

double hills(int x, int y) {
    const glm::dvec2 uv((x + 0.5) / size, (y + 0.5) / size);
    return 0.18 + 0.12 * fractal_noise(uv, 4, 3, 301);
}

void raise(Grid<double>& height, int x, int y, double to) {
    double& h = height.tiled(x, y);
    if (to > h) h = to;
}

void add_dome(Grid<double>& height, int cx, int cy, double radius) {
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double r = length({x + 0.5 - cx, y + 0.5 - cy}) / radius;
            if (r < 1) raise(height, x, y, 0.2 + 0.8 * std::sqrt(1 - r * r));
        }
}

void add_pyramid(Grid<double>& height, int cx, int cy, int half, int steps) {
    for (int y = cy - half; y < cy + half; ++y)
        for (int x = cx - half; x < cx + half; ++x) {
            const double r = std::max(std::fabs(x + 0.5 - cx), std::fabs(y + 0.5 - cy)) / half;
            raise(height, x, y, 0.25 + 0.75 * std::ceil((1 - r) * steps) / steps);
        }
}

void add_walls(Grid<double>& height, int x0, int y0) {
    for (int i = 0; i < 44; ++i) {
        raise(height, x0 + i, y0, 0.95);                     // along x
        raise(height, x0, y0 + i, 0.85);                     // along y
        raise(height, x0 + 6 + i / 2, y0 + 6 + i / 2, 0.9);  // diagonal
    }
    for (int tooth = 0; tooth < 10; ++tooth)
        for (int i = 0; i < 12; ++i) raise(height, x0 + 22 + 2 * tooth, y0 + 30 + i, 0.75);
}

void add_spikes(Grid<double>& height, int x0, int y0) {
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 5; ++column)
            raise(height, x0 + 9 * column + row % 2 * 4, y0 + 9 * row,
                  0.6 + 0.4 * random(column, row, 302));
}

Grid<double> make_height() {
    auto height = make_grid<double>(size, size, hills);
    add_dome(height, 32, 32, 24);
    add_pyramid(height, 96, 32, 24, 6);
    add_walls(height, 10, 74);
    add_spikes(height, 76, 76);
    return height;
}

glm::dvec4 colour_at(const Grid<double>& height, int x, int y) {
    static const glm::dvec3 low = srgb(0x4a5d6e), high = srgb(0xe6d5b8), line = srgb(0x8c3b2a);
    const bool on_line = x % 16 == 0 || y % 16 == 0;
    const glm::dvec3 ground = mix(low, high, height.at(x, y));
    return {mix(ground, line, on_line ? 0.7 : 0.0), 1};
}

glm::dvec4 normal_at(const Grid<double>& height, int x, int y) {
    const double du = (height.tiled(x + 1, y) - height.tiled(x - 1, y)) * 0.5 * size;
    const double dv = (height.tiled(x, y + 1) - height.tiled(x, y - 1)) * 0.5 * size;
    return {normalize(glm::dvec3(-du * tile_depth, -dv * tile_depth, 1)), height.at(x, y)};
}

}  // namespace

void write_obstacles(const std::filesystem::path& directory) {
    const Grid<double> height = make_height();
    write_height(directory / "obstacles_height.exr", height);
    write_colour(
        directory / "obstacles_color.exr",
        make_grid<glm::dvec4>(size, size, [&](int x, int y) { return colour_at(height, x, y); }));
    write_normal_height(
        directory / "obstacles_normal_height.exr",
        make_grid<glm::dvec4>(size, size, [&](int x, int y) { return normal_at(height, x, y); }));
}

}  // namespace quadrel::textures
