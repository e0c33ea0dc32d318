// A city from above: streets, and blocks of buildings with flat roofs and vertical walls.
#include <algorithm>

#include "colour.hpp"
#include "noise.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

constexpr int size = 512, block = 128, street = 16, alley = 4;

/// Half-open, in texels.
struct Rectangle {
    int x0, y0, x1, y1;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    Rectangle shrunk(int by) const { return {x0 + by, y0 + by, x1 - by, y1 - by}; }
    bool on_rim(int x, int y) const { return x == x0 || y == y0 || x == x1 - 1 || y == y1 - 1; }
    double vary(std::uint32_t seed) const { return random(x0 * 1024 + x1, y0 * 1024 + y1, seed); }
};

struct City {
    Grid<double> height{size, size};
    Grid<glm::dvec4> colour{size, size};
    Grid<glm::dvec3> glow{size, size};
};

template <class Visit>
void for_texels(const Rectangle& area, Visit visit) {
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) visit(x, y);
}

double grain(int x, int y, std::uint32_t seed) { return random(x, y, seed) - 0.5; }

/// Asphalt with a dashed line in the middle, lamps along the kerb; the whole tile, painted first.
void pave(City& city) {
    for_texels({0, 0, size, size}, [&](int x, int y) {
        const int across_x = x % block, across_y = y % block;
        const glm::dvec2 uv = glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size);
        glm::dvec3 colour = srgb(0x3b3d41) * (1 + 0.2 * fractal_noise(uv, 24, 3, 501));
        const bool dash = (across_x == street / 2 && across_y >= street && y % 12 < 6) ||
                          (across_y == street / 2 && across_x >= street && x % 12 < 6);
        if (dash) colour = srgb(0xd9d2b0);
        city.colour.at(x, y) = {colour, 1};
        const bool lamp =
            (across_x == 2 && across_y % 32 == 24) || (across_y == 2 && across_x % 32 == 24);
        if (lamp) city.glow.at(x, y) = glm::dvec3(2.2, 1.5, 0.6);
    });
}

/// Lit windows on the outermost texels of a roof: a wall shows its rim, drawn out downwards.
void light_windows(City& city, const Rectangle& roof) {
    if (roof.vary(511) < 0.25) return;
    const glm::dvec3 tint = mix(glm::dvec3(1.5, 0.95, 0.35), glm::dvec3(0.5, 1.0, 1.5),
                                roof.vary(512) < 0.7 ? 0.15 * roof.vary(513) : 0.9);
    for_texels(roof, [&](int x, int y) {
        const bool column = roof.on_rim(x, y) && (x + y) % 3 == 0;
        if (column && random(x, y, 514) < 0.45) city.glow.at(x, y) = tint;
    });
}

void paint_roof(City& city, const Rectangle& roof, double level) {
    static const glm::dvec3 palette[] = {srgb(0x8d8f92), srgb(0x6f6a66), srgb(0xa79f92),
                                         srgb(0x7d5a4c), srgb(0x59636c), srgb(0xb4b2ac),
                                         srgb(0x8a7460)};
    const glm::dvec3 base = palette[static_cast<int>(roof.vary(521) * 7)];
    for_texels(roof, [&](int x, int y) {
        const double rim = roof.on_rim(x, y) ? 1.25 : 1;
        city.height.at(x, y) = level;
        city.colour.at(x, y) = {base * rim * (1 + 0.12 * grain(x, y, 522)), 1};
        city.glow.at(x, y) = glm::dvec3(0);
    });
    light_windows(city, roof);
}

/// Lawn and trees.
void paint_park(City& city, const Rectangle& lot) {
    for_texels(lot, [&](int x, int y) {
        const glm::dvec2 uv = glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size);
        const double tree = smoothstep(0.1, 0.5, fractal_noise(uv, 64, 1, 531));
        city.height.at(x, y) = 0.02 + std::floor(6 * tree) / 6 * 0.09;
        city.colour.at(x, y) = {
            mix(srgb(0x6a8a3c), srgb(0x2f4f22), tree) * (1 + 0.2 * grain(x, y, 532)), 1};
    });
}

/// Roofs lie at multiples of 1/32; towers step inwards.
void build(City& city, const Rectangle& lot, double downtown) {
    if (lot.vary(541) < 0.07) return paint_park(city, lot);
    const double wish = 0.12 + 0.3 * lot.vary(542) + downtown * 0.55 * lot.vary(543);
    double level = std::floor(32 * wish) / 32;
    paint_roof(city, lot, level);
    Rectangle step = lot;
    for (std::uint32_t floor = 0; floor < 3; ++floor) {
        step = step.shrunk(2 + static_cast<int>(4 * lot.vary(550 + floor)));
        if (std::min(step.width(), step.height()) < 5 || lot.vary(560 + floor) < 0.35) return;
        level = std::min(1.0, level + (1 + std::floor(7 * downtown * lot.vary(570 + floor))) / 32);
        paint_roof(city, step, level);
    }
}

/// Splits a lot across its longer side, with an alley between, until the parts are small.
void subdivide(City& city, const Rectangle& lot, double downtown) {
    const bool wide = lot.width() > lot.height();
    const int extent = wide ? lot.width() : lot.height();
    if (extent < 26 || (extent < 44 && lot.vary(581) < 0.3)) return build(city, lot, downtown);
    const int cut = static_cast<int>(extent * (0.35 + 0.3 * lot.vary(582))), half = alley / 2;
    Rectangle a = lot, b = lot;
    if (wide) a.x1 = lot.x0 + cut - half, b.x0 = lot.x0 + cut + half;
    if (!wide) a.y1 = lot.y0 + cut - half, b.y0 = lot.y0 + cut + half;
    subdivide(city, a, downtown);
    subdivide(city, b, downtown);
}

void lay_block(City& city, int column, int row) {
    const Rectangle ground{column * block + street, row * block + street, (column + 1) * block,
                           (row + 1) * block};
    for_texels(ground, [&](int x, int y) {
        city.height.at(x, y) = 1.0 / 64;  // pavement
        city.colour.at(x, y) = {srgb(0x85837e) * (1 + 0.15 * grain(x, y, 591)), 1};
        city.glow.at(x, y) = glm::dvec3(0);
    });
    subdivide(city, ground.shrunk(3), 0.35 + 0.65 * random(column, row, 592));
}

}  // namespace

void write_city(const std::filesystem::path& directory) {
    City city;
    pave(city);
    for (int row = 0; row < size / block; ++row)
        for (int column = 0; column < size / block; ++column) lay_block(city, column, row);
    write_height(directory / "city_height.exr", city.height);
    write_colour(directory / "city_color.exr", city.colour);
    write_radiance(directory / "city_emissive.exr", city.glow);
}

}  // namespace quadrel::textures
