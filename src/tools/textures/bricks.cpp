// Maps of the brick wall. The height map has a dual in one texture with its tangent-space normals,
// and a small copy as PNG.
#include "brick_wall.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

/// (-dh/du, -dh/dv, 1 / depth), normalised, for a relief `depth` tiles deep; v grows with the row.
glm::dvec3 normal_at(const Grid<double>& height, int x, int y, double depth) {
    const double du = (height.tiled(x + 1, y) - height.tiled(x - 1, y)) * 0.5 * height.width;
    const double dv = (height.tiled(x, y + 1) - height.tiled(x, y - 1)) * 0.5 * height.height;
    return normalize({-du * depth, -dv * depth, 1});
}

template <class T, class Function>
Grid<T> map_of(int size, Function value) {
    return make_grid<T>(size, size, [&](int x, int y) {
        return value(glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(size));
    });
}

void write_normals(const std::filesystem::path& file) {
    const auto height = map_of<double>(256, wall_height);
    write_normal_height(file, make_grid<glm::dvec4>(256, 256, [&](int x, int y) {
                            const glm::dvec3 n = normal_at(height, x, y, 0.05);
                            return glm::dvec4(n * 0.5 + 0.5, height.at(x, y));
                        }));
}

}  // namespace

void write_bricks(const std::filesystem::path& directory) {
    write_height(directory / "bricks_height.exr", map_of<double>(512, wall_height));
    write_colour(directory / "bricks_color.exr", map_of<glm::dvec4>(512, wall_colour));
    write_data(directory / "bricks_gloss.exr", map_of<glm::dvec3>(256, wall_gloss));
    write_normals(directory / "bricks_normal_height.exr");
    write_height_png(directory / "bricks_height_256.png", map_of<double>(256, wall_height));
    write_colour_png(directory / "bricks_color_256.png", map_of<glm::dvec4>(256, wall_colour));
}

}  // namespace quadrel::textures
