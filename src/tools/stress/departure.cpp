#include "stress/departure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace quadrel::stress {
namespace {

/// Beyond this a small change of the ray moves its first hit by far: |ds/dh|.
constexpr double steep = 8;

double value(const Film& film, const char* name, std::size_t pixel) {
    return film.find(name)->as_float(pixel);
}

/// The shorter way from a to b around a circle.
double around(double a, double b, double period) {
    const double distance = std::abs(a - b);
    const double turns = distance - period * std::floor(distance / period);
    return std::fmin(turns, period - turns);
}

struct Axis {
    const char *cell, *place, *K;
};
constexpr Axis axes[] = {{"oracle.cell.X", "oracle.place.X", "K.U"},
                         {"oracle.cell.Y", "oracle.place.Y", "K.V"}};

/// Where the certified hit is along an axis, in texels within a period.
double certified_place(const Film& film, const Axis& axis, std::size_t i) {
    return static_cast<std::int32_t>(film.find(axis.cell)->bits[i]) + value(film, axis.place, i);
}

/// From the certified hit to the hit, in texels.
double search_error(const Film& film, const Axis& axis, std::size_t i, double size) {
    return (value(film, "hit.s", i) - value(film, "oracle.s", i)) * value(film, axis.K, i) * size;
}

bool is_certified_hit(const Film& film, std::size_t i) {
    return film.find("certified")->bits[i] != 0 && film.find("hit.status")->bits[i] == 1;
}

/// What 99 % of the values do not exceed; 0 of none.
double most_of(std::vector<double>& values) {
    if (values.empty()) return 0;
    const std::size_t at = (values.size() - 1) * 99 / 100;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at),
                     values.end());
    return values[at];
}

double length(double x, double y) { return std::sqrt(x * x + y * y); }

/// The distance of neighbouring floats at a texture coordinate, in texels.
double spacing(double coordinate, double size) {
    return std::abs(coordinate) * std::numeric_limits<float>::epsilon() * size;
}

}  // namespace

Departures::Departures(const Film& single, const Film& exact, int width, int height)
    : single_(single),
      exact_(exact),
      size_{static_cast<double>(width), static_cast<double>(height)} {}

PixelDeparture Departures::at(std::size_t i) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (!is_certified_hit(single_, i) || !is_certified_hit(exact_, i))
        return {nan, nan, nan, nan, nan};
    double rays[2], hits[2], of_float[2], of_double[2];
    for (std::size_t k = 0; k < 2; ++k) {
        const double size = size_[k], period = 2 * size;  // mirrored maps repeat after two
        const double a = certified_place(single_, axes[k], i);
        const double b = certified_place(exact_, axes[k], i);
        of_float[k] = search_error(single_, axes[k], i, size);
        of_double[k] = search_error(exact_, axes[k], i, size);
        rays[k] = std::fmin(around(a, b, period), around(a, b, size));
        hits[k] = std::fmin(around(a + of_float[k], b + of_double[k], period),
                            around(a + of_float[k], b + of_double[k], size));
    }
    return {length(rays[0], rays[1]), length(hits[0], hits[1]), length(of_float[0], of_float[1]),
            length(of_double[0], of_double[1]),
            length(of_float[0] - of_double[0], of_float[1] - of_double[1])};
}

std::array<int, 2> height_size(const Scene& scene) {
    const std::array<int, 2> size = {64, 64};
    const auto& textures = scene.materials.front().textures;
    const auto height = textures.find("height");
    if (height == textures.end()) return size;
    const std::string file = height->second.file.stem().string();
    const std::size_t dash = file.rfind('-'), cross = file.rfind('x');
    if (dash == std::string::npos || cross == std::string::npos || cross < dash) return size;
    return {std::stoi(file.substr(dash + 1)), std::stoi(file.substr(cross + 1))};
}

namespace {

/// The few planes that are looked at for each pixel: among them they are soon found.
Film of_interest(const Film& film) {
    Film some{film.frame, film.window, {}};
    for (const char* name :
         {"K.U", "K.V", "uv.U", "uv.V", "hit.s", "hit.status", "certified", "oracle.s",
          "oracle.cell.X", "oracle.cell.Y", "oracle.place.X", "oracle.place.Y", "oracle.condition"})
        some.planes.push_back(*film.find(name));
    return some;
}

/// Why a pixel's hits are apart: adds one to what names it.
void add_cause(const Film& single, const Film& exact, std::size_t i, double width, double height,
               const PixelDeparture& pixel, Departure& sum) {
    const double own =
        length(spacing(value(single, "uv.U", i), width), spacing(value(single, "uv.V", i), height));
    const double turned = length((value(single, "K.U", i) - value(exact, "K.U", i)) * width,
                                 (value(single, "K.V", i) - value(exact, "K.V", i)) * height);
    if (own >= half_texel / 2)
        ++sum.from_uv;
    else if (turned >= half_texel)
        ++sum.from_frame;
    else if (value(single, "oracle.condition", i) > steep || pixel.rays >= half_texel)
        ++sum.from_grazing;
    else
        ++sum.from_search;
}

}  // namespace

Departure departure(const Film& float_film, const Film& double_film, const Scene& scene) {
    const Film single = of_interest(float_film), exact = of_interest(double_film);
    const auto [width, height] = height_size(scene);
    const Departures all(single, exact, width, height);
    Departure sum{scene.materials.front().frame.id, scene.materials.front().trace.id};
    std::vector<double> rays, searches;
    for (std::size_t i = 0; i < single.window.area(); ++i) {
        const PixelDeparture pixel = all.at(i);
        if (std::isnan(pixel.hits)) continue;
        ++sum.pixels;
        rays.push_back(pixel.rays);
        searches.push_back(pixel.searches);
        sum.search_beyond += pixel.single_search >= half_texel;
        sum.double_beyond += pixel.double_search >= half_texel;
        if (pixel.hits < half_texel) continue;
        ++sum.beyond;
        add_cause(single, exact, i, width, height, pixel, sum);
    }
    sum.rays_99 = most_of(rays);
    sum.searches_99 = most_of(searches);
    return sum;
}

}  // namespace quadrel::stress
