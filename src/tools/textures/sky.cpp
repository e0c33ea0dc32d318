// An environment cube map: sky, sun in the direction (1, 1, 1), and a tiled floor to the horizon.
// Computed from directions, hence without seams. Faces in the order and orientation of OpenGL and
// Vulkan: (s, t) from the table of major axes (OpenGL 4.6 core, table 8.19).
#include <algorithm>

#include "colour.hpp"
#include "recipes.hpp"
#include "shaping.hpp"
#include "write_image.hpp"

namespace quadrel::textures {
namespace {

struct Face {
    const char* file;
    glm::dvec3 major, s, t;  // direction = major + s * (-1..1) + t * (-1..1)
};
constexpr Face faces[6] = {{"sky_px.exr", {1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                           {"sky_nx.exr", {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                           {"sky_py.exr", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                           {"sky_ny.exr", {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                           {"sky_pz.exr", {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                           {"sky_nz.exr", {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};

double power_of_two_power(double x, int doublings) {
    for (int i = 0; i < doublings; ++i) x *= x;
    return x;
}

glm::dvec3 sky_radiance(glm::dvec3 d) {
    const double low = 1 - saturate(d.y);
    const glm::dvec3 clear = mix(srgb(0x2f66b8), srgb(0xdfeaf4), low * low * low * low);
    const double towards_sun = saturate(dot(d, normalize({1, 1, 1})));
    const glm::dvec3 warm(1.0, 0.86, 0.62);
    const double halo =
        0.35 * power_of_two_power(towards_sun, 3) + 2.0 * power_of_two_power(towards_sun, 8);
    const double disc = 30 * smoothstep(0.9976, 0.9984, towards_sun);
    return clear + warm * (halo + disc);
}

/// 1 within the lines of a unit grid of relative width `width`, else 0.
double grid_line(glm::dvec2 p, double width) {
    const double x = p.x - std::floor(p.x), y = p.y - std::floor(p.y);
    return std::min({x, 1 - x, y, 1 - y}) < 0.5 * width ? 1 : 0;
}

glm::dvec3 floor_radiance(glm::dvec3 d) {
    const glm::dvec2 p(d.x / -d.y * 1.6, d.z / -d.y * 1.6);
    const bool odd = (static_cast<long>(std::floor(p.x)) + static_cast<long>(std::floor(p.y))) & 1;
    const glm::dvec3 tiles = odd ? srgb(0x8f8273) : srgb(0x4d4a4a);
    const glm::dvec3 lined = mix(tiles, srgb(0xc9bfae), grid_line(p, 0.06));
    // Far tiles are finer than a texel: fade to haze.
    const double haze = smoothstep(0.22, 0.0, -d.y);
    return mix(lined, srgb(0xb9c0c4), haze);
}

glm::dvec3 radiance(glm::dvec3 direction) {
    const glm::dvec3 d = normalize(direction);
    return d.y > -1e-3 ? sky_radiance(d) : floor_radiance(d);
}

/// Mean over 8x8 points of the texel.
glm::dvec3 texel(const Face& face, int x, int y, int size) {
    constexpr int samples = 8;
    glm::dvec3 sum(0);
    for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
            const double s = 2 * (x + (i + 0.5) / samples) / size - 1;
            const double t = 2 * (y + (j + 0.5) / samples) / size - 1;
            sum += radiance(face.major + face.s * s + face.t * t);
        }
    return sum / static_cast<double>(samples * samples);
}

}  // namespace

void write_sky(const std::filesystem::path& directory) {
    constexpr int size = 128;
    for (const Face& face : faces)
        write_radiance(directory / face.file, make_grid<glm::dvec3>(size, size, [&](int x, int y) {
                           return texel(face, x, y, size);
                       }));
}

}  // namespace quadrel::textures
