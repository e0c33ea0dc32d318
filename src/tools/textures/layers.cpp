// Depth layers: a curtain, front and back; and a lattice over a floor, four depths, with the
// normals of all four. Where there is nothing, front and back meet in the middle of what is beside,
// so that rims close smoothly.
#include <algorithm>

#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

constexpr int size = 128;

/// From 0 to 1 and back over a period of 1, smooth.
double wave(double x) {
    const double phase = x - std::floor(x);
    return smoothstep(0, 1, phase < 0.5 ? 2 * phase : 2 - 2 * phase);
}

/// The curtain's cloth at u: drawn apart in the middle, its folds narrower towards the sides.
double fold(double u) {
    const double side = std::fabs(u - 0.5);
    return 0.25 + 0.45 * wave(side * (4 + 8 * side));
}

/// How far a place is inside of the cloth: below 0 above its scalloped hem and between its halves.
double inside_cloth(double u, double v) {
    const double opening = 0.05 + 0.1 * smoothstep(0.2, 0.9, v);
    const double hem = 0.9 + 0.04 * wave(16 * u);
    const double from_middle = std::fabs(u - 0.5) - opening;
    return std::min(std::min(from_middle, 0.49 - std::fabs(u - 0.5)), std::min(hem - v, v - 0.02));
}

/// Front and back; nothing else.
glm::dvec4 curtain_at(int x, int y) {
    const double u = (x + 0.5) / size, v = (y + 0.5) / size;
    const double middle = fold(u), half = inside_cloth(u, v) > 0 ? 0.03 : 0;
    return {middle - half, middle + half, 1, 1};
}

/// 1 in the cloth, 0 beside it.
glm::dvec4 cloth_at(int x, int y) {
    return glm::dvec4(inside_cloth((x + 0.5) / size, (y + 0.5) / size) > 0 ? 1 : 0);
}

/// Half the thickness of a round bar, `distance` from its axis.
double bar(double distance) {
    constexpr double radius = 0.034;
    const double t = distance / radius;
    return t < 1 ? 0.15 * std::sqrt(1 - t * t) : 0;
}
/// To the nearest of four bars a tile.
double to_bar(double x) {
    const double phase = 4 * x - std::floor(4 * x);
    return std::fabs(phase - 0.5) / 4;
}

/// Bars along both axes, and below them a floor with a round hole.
glm::dvec4 lattice_at(int x, int y) {
    const double u = (x + 0.5) / size, v = (y + 0.5) / size;
    const double half = std::max(bar(to_bar(u)), bar(to_bar(v)));
    const double floor = length({u - 0.5, v - 0.5}) > 0.2 ? 0.06 : 0;
    return {0.25 - half, 0.25 + half, 0.9 - floor, 0.9 + floor};
}

/// World depth of the lattice's relief a length of its tile: that of the scenes that read the
/// normals.
constexpr double lattice_depth = 0.15;

/// A component of the four layers' unit normals, along u (axis 0) or v, as n * 0.5 + 0.5. Fronts
/// face the top, backs the bottom; slopes are differences over two texels.
glm::dvec4 lattice_normal(int x, int y, int axis) {
    const auto slopes = [](const glm::dvec4& next, const glm::dvec4& last) {
        return (next - last) * (0.5 * size * lattice_depth);
    };
    const glm::dvec4 along_u = slopes(lattice_at(x + 1, y), lattice_at(x - 1, y));
    const glm::dvec4 along_v = slopes(lattice_at(x, y + 1), lattice_at(x, y - 1));
    const glm::dvec4& along = axis == 0 ? along_u : along_v;
    glm::dvec4 normal;
    for (int layer = 0; layer < 4; ++layer) {
        const double n = along[layer] / std::sqrt(1 + along_u[layer] * along_u[layer] +
                                                  along_v[layer] * along_v[layer]);
        normal[layer] = 0.5 + 0.5 * (layer % 2 == 0 ? n : -n);
    }
    return normal;
}

}  // namespace

void write_layers(const std::filesystem::path& directory) {
    write_depths(directory / "curtain_layers.exr", 2,
                 make_grid<glm::dvec4>(size, size, curtain_at));
    write_depths(directory / "curtain_cloth.exr", 2, make_grid<glm::dvec4>(size, size, cloth_at));
    write_depths(directory / "lattice_layers.exr", 4,
                 make_grid<glm::dvec4>(size, size, lattice_at));
    for (const int axis : {0, 1})
        write_depths(directory / (axis == 0 ? "lattice_normals_x.exr" : "lattice_normals_y.exr"), 4,
                     make_grid<glm::dvec4>(
                         size, size, [axis](int x, int y) { return lattice_normal(x, y, axis); }));
}

}  // namespace quadrel::textures
