#include "relief/error_maps.hpp"

#include <fmt/format.h>

#include <cmath>

#include "quadrel/num/math.hpp"

namespace quadrel::bench {
namespace {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014), in [0, 1).
double random(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// A lattice of random values that repeats, `cells` a side, bilinear between them.
double value_noise(int x, int y, int cells) {
    const auto lattice = [cells](int i, int j) {
        std::uint64_t state =
            static_cast<std::uint64_t>((cells * 1024 + j % cells) * 1024 + i % cells);
        return random(state);
    };
    const double px = double(x) * cells / texels, py = double(y) * cells / texels;
    const int i = static_cast<int>(px), j = static_cast<int>(py);
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double f = smooth(px - i), g = smooth(py - j);
    return (lattice(i, j) * (1 - f) + lattice(i + 1, j) * f) * (1 - g) +
           (lattice(i, j + 1) * (1 - f) + lattice(i + 1, j + 1) * f) * g;
}

double fractal(int x, int y) {
    double sum = 0, weight = 0.5;
    for (int cells = 4; cells <= 64; cells *= 2, weight /= 2)
        sum += weight * value_noise(x, y, cells);
    return sum / 0.96875;
}

}  // namespace

const std::vector<NamedMap>& error_maps() {
    static std::uint64_t state = 1;
    static const std::vector<NamedMap> all{
        {"fractal", fractal},
        {"spikes", [](int, int) { return random(state) < 1.0 / 128 ? 1.0 : 0.0; }},
        {"walls", [](int x, int y) { return x % 16 == 0 || y % 16 == 0 ? 1.0 : 0.0; }},
        {"checker", [](int x, int y) { return (x / 8 + y / 8) % 2 == 0 ? 1.0 : 0.0; }},
    };
    return all;
}

std::shared_ptr<const Texture> make_error_map(const NamedMap& map) {
    Image image;
    image.width = image.height = texels;
    image.channels = 1;
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x)
            image.values.push_back(static_cast<float>(map.height(x, y)));
    TextureOptions options;
    options.mip_rule = MipRule::none;
    return make_texture(image, options);
}

void set_rays(Fragments& fragments, double degrees) {
    std::uint64_t state = 7;
    const double theta = degrees * 0.017453292519943295, kappa = depth * sin(theta) / cos(theta);
    for (int lane = 0; lane < fragments.count(); ++lane) {
        const double azimuth = 6.283185307179586 * random(state);
        const double u = random(state), v = random(state);
        fragments.set_ray(lane, u, v, kappa * cos(azimuth), kappa * sin(azimuth), cos(theta));
    }
}

std::string number(double x) {
    if (x < 0.005) return "0";
    return x < 99.5 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x);
}

void print_head(const std::string& first) {
    fmt::print("| {} | |", first);
    for (const NamedMap& map : error_maps()) fmt::print(" {} |", map.name);
    fmt::print("\n|---|---|");
    for (std::size_t i = 0; i < error_maps().size(); ++i) fmt::print("---|");
    fmt::print("\n");
}

}  // namespace quadrel::bench
