// Renders whose pixels are integrals, errors planted into them, and a scene of which the areas are
// known.
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "quadrel/render.hpp"
#include "render/films.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {

inline Film integrate(const Scene& scene, const IntegralOptions& integral,
                      RenderOptions options = {}) {
    options.integral = integral;
    return render(scene, options);
}

/// What the checks are run on.
using Integrator = std::function<Film(const Scene&, const IntegralOptions&)>;

inline Film honest(const Scene& scene, const IntegralOptions& integral) {
    return integrate(scene, integral);
}

inline void set_value(Film& film, const std::string& channel, std::size_t pixel, double value) {
    film.find(channel)->bits[pixel] = std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

/// Every sample at the pixel's centre: that of an ordinary render.
inline Film centres_alone(const Scene& scene, const IntegralOptions& integral) {
    Film film = integrate(scene, integral);
    RenderOptions options;
    options.channels = {"R", "G", "B", "A"};
    const Film centres = render(scene, options);
    for (Plane& plane : film.planes)
        if (const Plane* of_centre = centres.find(plane.name))
            plane.bits = of_centre->bits;
        else if (plane.name.starts_with("integral.error"))
            std::fill(plane.bits.begin(), plane.bits.end(), 0u);
    return film;
}

/// Filtered by a tent of two pixels' width, not over the pixel.
inline Film wide_filter(const Scene& scene, const IntegralOptions& integral) {
    const Film film = integrate(scene, integral);
    Film wide = film;
    const Window& w = film.window;
    for (const char* channel : {"R", "G", "B", "A"})
        for (int y = w.y0; y < w.y1; ++y)
            for (int x = w.x0; x < w.x1; ++x) {
                double sum = 0;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) / 16.0 *
                               value(film, channel, std::clamp(x + dx, w.x0, w.x1 - 1),
                                     std::clamp(y + dy, w.y0, w.y1 - 1));
                set_value(wide, channel, wide.index(x, y), sum);
            }
    return wide;
}

/// The mean of codes, not of light. For scenes whose light is the emission of plain materials.
inline Film mean_of_codes(Scene scene, const IntegralOptions& integral) {
    for (int c = 0; c < 3; ++c) {
        scene.background[c] = std::pow(scene.background[c], 1 / 2.2f);
        for (Material& material : scene.materials)
            material.emission[c] = std::pow(material.emission[c], 1 / 2.2f);
    }
    Film film = integrate(scene, integral);
    for (const char* channel : {"R", "G", "B"})
        for (std::size_t i = 0; i < film.window.area(); ++i)
            set_value(film, channel, i, std::pow(film.find(channel)->as_float(i), 2.2));
    return film;
}

/// Standard errors by a factor.
inline Integrator with_errors_by(double factor) {
    return [factor](const Scene& scene, const IntegralOptions& integral) {
        Film film = integrate(scene, integral);
        for (const char* channel : {"integral.error.R", "integral.error.G", "integral.error.B"})
            for (std::size_t i = 0; i < film.window.area(); ++i)
                set_value(film, channel, i, factor * film.find(channel)->as_float(i));
        return film;
    };
}

using Corners = std::array<std::array<double, 2>, 3>;

/// Area of the part of a triangle that lies in the pixel [x, x + 1) x [y, y + 1): clipped to one
/// side of it after the other.
inline double area_in_pixel(const Corners& triangle, int x, int y) {
    std::vector<std::array<double, 2>> polygon(triangle.begin(), triangle.end());
    for (std::size_t axis = 0; axis < 2; ++axis)
        for (const double sign : {1.0, -1.0}) {
            const double side = (axis == 0 ? x : y) + (sign < 0 ? 1 : 0);
            const auto inside = [&](const auto& p) { return sign * (p[axis] - side); };
            std::vector<std::array<double, 2>> kept;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                const double da = inside(a), db = inside(b);
                if (da >= 0) kept.push_back(a);
                if ((da >= 0) == (db >= 0)) continue;
                const double t = da / (da - db);
                kept.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
            }
            polygon = kept;
        }
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return std::abs(twice) / 2;
}

/// A triangle in each cell of 6 x 6 pixels, at random, of one colour before another: what each
/// pixel's mean is is known.
struct TriangleField {
    static constexpr int cell = 6;
    static constexpr double light = 0.95, dark = 0.05;

    int cells;
    Scene scene;
    std::vector<Corners> triangles;  ///< in image coordinates

    explicit TriangleField(int cells_a_side, unsigned seed = 1)
        : cells(cells_a_side), scene(empty_scene(cell * cells_a_side, cell * cells_a_side)) {
        scene.background = glm::vec4(dark, dark, dark, 0);
        set_pixel_camera(scene);
        scene.materials = {plain_material("light", glm::vec3(light))};
        std::uint32_t state = seed;
        const auto corner = [&] {
            state = state * 1664525u + 1013904223u;
            return static_cast<double>((state >> 12) % (cell * 256)) / 256;
        };
        for (int i = 0; i < cells * cells; ++i) {
            Corners t{};
            for (auto& p : t) p = {cell * (i % cells) + corner(), cell * (i / cells) + corner()};
            triangles.push_back(t);
            add_object(scene, triangle(in_eye(t[0]), in_eye(t[1]), in_eye(t[2])), 0);
        }
    }

    /// Share of the pixel that its cell's triangle covers.
    double area(int x, int y) const {
        return area_in_pixel(triangles[static_cast<std::size_t>(y / cell * cells + x / cell)], x,
                             y);
    }
    double mean(int x, int y) const { return dark + (light - dark) * area(x, y); }

  private:
    glm::vec3 in_eye(const std::array<double, 2>& p) const {
        const double half = cell * cells / 2.0;
        return {p[0] - half, half - p[1], -5};
    }
};

}  // namespace quadrel::render_tests
