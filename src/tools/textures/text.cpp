// The word QUADREL in raised strokes 2 to 6 texels wide: thin walls that relief algorithms lose.
#include <string_view>

#include "colour.hpp"
#include "noise.hpp"
#include "recipes.hpp"
#include "stroke_font.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

constexpr int size = 512;
constexpr std::string_view word = "QUADREL ";

struct Line {
    int top, height;  ///< texels
    double stroke;    ///< width of the strokes, texels
    double shift;     ///< letters that the line is moved to the right
};
// Letters are half as wide as their line is high, so eight cells fill the tile once or twice.
constexpr Line lines[] = {{0, 128, 6, 0.5},   {128, 64, 4, 3}, {192, 64, 3, 0},
                          {256, 128, 5, 4.5}, {384, 64, 2, 1}, {448, 64, 3, 6}};

const Line& line_at(double y) {
    const Line* found = lines;
    for (const Line& line : lines)
        if (y >= line.top) found = &line;
    return *found;
}

/// 1 on a stroke, 0 beside it, a ramp of one texel between.
double stroke_at(glm::dvec2 p) {
    const Line& line = line_at(p.y);
    const double cell = line.height / 2.0;
    const glm::dvec2 letter_size(0.60 * cell, 0.62 * line.height);
    const double x = p.x / cell - line.shift;
    const int index = static_cast<int>(std::floor(x));
    const char letter = word[((index % 8) + 8) % 8];
    const glm::dvec2 local((x - index) * cell - 0.20 * cell, p.y - line.top - 0.19 * line.height);
    return saturate(0.5 * line.stroke + 0.5 - distance_to_letter(letter, local, letter_size));
}

template <class T, class Function>
Grid<T> map_of(Function value) {
    return make_grid<T>(size, size,
                        [&](int x, int y) { return value(glm::dvec2(x + 0.5, y + 0.5)); });
}

glm::dvec4 colour_at(glm::dvec2 p) {
    const glm::dvec2 uv = p / static_cast<double>(size);
    const double brushed = fractal_noise(uv, {4, 128}, 2, 401),
                 stain = fractal_noise(uv, 4, 4, 402);
    const glm::dvec3 plate =
        mix(srgb(0x24384a), srgb(0x35586b), saturate(0.5 + 0.6 * stain)) * (1 + 0.15 * brushed);
    const glm::dvec3 gold = srgb(0xe2b34c) * (1 + 0.10 * stain);
    return {mix(plate, gold, stroke_at(p)), 1};
}

/// Shininess / 255, relative index of refraction / 2, mirror.
glm::dvec3 gloss_at(glm::dvec2 p) {
    const double stroke = stroke_at(p);
    return {mix(30.0, 90.0, stroke) / 255, 1 / 1.5 / 2, mix(0.06, 0.3, stroke)};
}

}  // namespace

void write_text(const std::filesystem::path& directory) {
    write_height(directory / "text_height.exr", map_of<double>(stroke_at));
    write_colour(directory / "text_color.exr", map_of<glm::dvec4>(colour_at));
    write_data(directory / "text_gloss.exr", map_of<glm::dvec3>(gloss_at));
}

}  // namespace quadrel::textures
