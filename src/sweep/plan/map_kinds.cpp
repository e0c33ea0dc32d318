#include "sweep/plan/map_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "file/data_path.hpp"
#include "quadrel/num/math.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel::sweep {
namespace {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014) of a texel and a seed, in [0, 1).
double random_at(int x, int y, int seed) {
    std::uint64_t z = (static_cast<std::uint64_t>(seed) << 48) ^
                      (static_cast<std::uint64_t>(y) << 24) ^ static_cast<std::uint64_t>(x);
    z = (z + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

template <class Height>
std::vector<float> heights_of(int size, const Height& height) {
    std::vector<float> heights;
    heights.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) heights.push_back(static_cast<float>(height(x, y)));
    return heights;
}

int whole(const MapValues& values, const char* name) { return static_cast<int>(values.at(name)); }

double smooth(double t) { return t * t * (3 - 2 * t); }

/// A lattice of random values that repeats, `cells` a side, smooth between them.
double value_noise(double u, double v, int cells) {
    const double px = u * cells, py = v * cells;
    const int i = static_cast<int>(std::floor(px)), j = static_cast<int>(std::floor(py));
    const auto lattice = [cells](int x, int y) {
        return random_at((x % cells + cells) % cells, (y % cells + cells) % cells, cells);
    };
    const double f = smooth(px - i), g = smooth(py - j);
    return (lattice(i, j) * (1 - f) + lattice(i + 1, j) * f) * (1 - g) +
           (lattice(i, j + 1) * (1 - f) + lattice(i + 1, j + 1) * f) * g;
}

double fractal_height(double u, double v, int octaves) {
    double sum = 0, weight = 0.5, all = 0;
    for (int octave = 0; octave < octaves; ++octave, weight /= 2) {
        sum += weight * value_noise(u, v, 4 << octave);
        all += weight;
    }
    return sum / all;
}

std::vector<float> make_flat(int size, const MapValues& values) {
    return heights_of(size, [&](int, int) { return values.at("level"); });
}

std::vector<float> make_ramp(int size, const MapValues&) {
    return heights_of(size, [&](int x, int) { return (x + 0.5) / size; });
}

std::vector<float> make_impulse(int size, const MapValues&) {
    return heights_of(size, [&](int x, int y) { return x == size / 2 && y == size / 2 ? 1 : 0; });
}

std::vector<float> make_spikes(int size, const MapValues& values) {
    const double share = 1 / values.at("one_in");
    return heights_of(size, [&](int x, int y) { return random_at(x, y, 1) < share ? 1 : 0; });
}

std::vector<float> make_walls(int size, const MapValues& values) {
    const int pitch = whole(values, "pitch"), direction = whole(values, "direction");
    return heights_of(size, [&](int x, int y) {
        const bool along_v = x % pitch == 0, along_u = y % pitch == 0;
        const bool diagonal = (x + y) % pitch == 0;
        const bool wall[] = {along_v || along_u, along_v, along_u, diagonal};
        return wall[direction] ? 1 : 0;
    });
}

std::vector<float> make_comb(int size, const MapValues&) {
    return heights_of(size, [](int x, int) { return x % 2; });
}

std::vector<float> make_checker(int size, const MapValues& values) {
    const int square = whole(values, "square");
    return heights_of(size, [&](int x, int y) { return (x / square + y / square) % 2 == 0; });
}

std::vector<float> make_cliff(int size, const MapValues&) {
    return heights_of(size, [&](int x, int) { return x < size / 2 ? 0 : 1; });
}

std::vector<float> make_steps(int size, const MapValues& values) {
    const int count = whole(values, "count");
    return heights_of(size, [&](int x, int y) {
        const double u = std::fabs(2 * (x + 0.5) / size - 1),
                     v = std::fabs(2 * (y + 0.5) / size - 1);
        return std::min(1.0, std::floor((1 - std::max(u, v)) * (count + 1)) / count);
    });
}

std::vector<float> make_sine(int size, const MapValues& values) {
    const double waves = values.at("waves") * 6.283185307179586;
    return heights_of(size, [&](int x, int y) {
        return 0.5 + 0.25 * (sin(waves * (x + 0.5) / size) + sin(waves * (y + 0.5) / size));
    });
}

std::vector<float> make_sphere(int size, const MapValues&) {
    return heights_of(size, [&](int x, int y) {
        const double u = 2 * (x + 0.5) / size - 1, v = 2 * (y + 0.5) / size - 1;
        return std::sqrt(std::max(0.0, 1 - (u * u + v * v) / 0.81));
    });
}

std::vector<float> make_noise(int size, const MapValues& values) {
    return heights_of(size,
                      [&](int x, int y) { return random_at(x, y, whole(values, "seed") + 2); });
}

std::vector<float> make_fractal(int size, const MapValues& values) {
    return heights_of(size, [&](int x, int y) {
        return fractal_height((x + 0.5) / size, (y + 0.5) / size, whole(values, "octaves"));
    });
}

/// A tenth above 1 and a tenth below 0.
std::vector<float> make_outside(int size, const MapValues&) {
    return heights_of(size, [&](int x, int y) {
        const double height = fractal_height((x + 0.5) / size, (y + 0.5) / size, 5);
        return std::clamp(3 * height - 1, -0.1, 1.1);
    });
}

std::vector<float> make_nan(int size, const MapValues&) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return heights_of(size,
                      [&](int x, int y) { return x == size / 2 && y == size / 2 ? nan : 0.5; });
}

/// A map of the data directory at another size: bilinear, and where it shrinks the mean of as many
/// points as it has texels there.
std::vector<float> resampled(const char* file, int size) {
    const Image image = load_image(find_data_file(file));
    const int n = image.width, points = std::max(1, (n + size - 1) / size);
    const auto texel = [&](int x, int y) {
        const int i = (x % n + n) % n, j = (y % image.height + image.height) % image.height;
        return double(image.values[static_cast<std::size_t>((j * n + i) * image.channels)]);
    };
    const auto bilinear = [&](double u, double v) {
        const double x = u * n - 0.5, y = v * image.height - 0.5;
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
        const double f = x - i, g = y - j;
        return (texel(i, j) * (1 - f) + texel(i + 1, j) * f) * (1 - g) +
               (texel(i, j + 1) * (1 - f) + texel(i + 1, j + 1) * f) * g;
    };
    return heights_of(size, [&](int x, int y) {
        double sum = 0;
        for (int j = 0; j < points; ++j)
            for (int i = 0; i < points; ++i)
                sum += bilinear((x + (i + 0.5) / points) / size, (y + (j + 0.5) / points) / size);
        return sum / (points * points);
    });
}

std::vector<float> make_bricks(int size, const MapValues&) {
    return resampled("textures/bricks_height.exr", size);
}
std::vector<float> make_stones(int size, const MapValues&) {
    return resampled("textures/stones_height.exr", size);
}
std::vector<float> make_text(int size, const MapValues&) {
    return resampled("textures/text_height.exr", size);
}
std::vector<float> make_city(int size, const MapValues&) {
    return resampled("textures/city_height.exr", size);
}

constexpr MapParameter flat_parameters[] = {{"level", "the height everywhere", 0.5, 0, 1}};
constexpr MapParameter spikes_parameters[] = {
    {"one_in", "one texel in so many is 1, the others are 0", 128, 2, 65536}};
constexpr MapParameter walls_parameters[] = {
    {"pitch", "texels from one wall to the next", 16, 2, 4096},
    {"direction", "0 a grid, 1 along v, 2 along u, 3 diagonal", 0, 0, 3}};
constexpr MapParameter checker_parameters[] = {{"square", "texels a side", 1, 1, 2048}};
constexpr MapParameter steps_parameters[] = {{"count", "levels above the floor", 6, 1, 256}};
constexpr MapParameter sine_parameters[] = {{"waves", "a side", 4, 1, 2048}};
constexpr MapParameter noise_parameters[] = {{"seed", "of the random numbers", 0, 0, 1000}};
constexpr MapParameter fractal_parameters[] = {{"octaves", "from 4 cells a side on", 5, 1, 10}};

constexpr MapKind all_kinds[] = {
    {"flat", "one height", "unorm16", flat_parameters, make_flat},
    {"ramp", "a plane from 0 to 1 and a fall back to 0", "unorm16", {}, make_ramp},
    {"impulse", "one texel that is 1", "unorm16", {}, make_impulse},
    {"spikes", "random texels that are 1", "unorm16", spikes_parameters, make_spikes},
    {"walls", "walls one texel thick", "unorm16", walls_parameters, make_walls},
    {"comb", "columns 0 and 1 in turns", "unorm16", {}, make_comb},
    {"checker", "squares 0 and 1 in turns", "unorm16", checker_parameters, make_checker},
    {"cliff", "a half that is 0 and one that is 1", "unorm16", {}, make_cliff},
    {"text", "raised letters of data/textures", "unorm16", {}, make_text},
    {"steps", "a stepped pyramid", "unorm16", steps_parameters, make_steps},
    {"sine", "waves in both directions", "unorm16", sine_parameters, make_sine},
    {"sphere", "half of one", "unorm16", {}, make_sphere},
    {"noise", "every texel random, in 8 bits", "unorm8", noise_parameters, make_noise},
    {"fractal", "octaves of value noise", "unorm16", fractal_parameters, make_fractal},
    {"bricks", "the wall of data/textures", "unorm16", {}, make_bricks},
    {"stones", "the cobbles of data/textures", "unorm16", {}, make_stones},
    {"city", "the houses of data/textures", "unorm16", {}, make_city},
    {"outside", "octaves that leave 0 to 1 on both sides", "float", {}, make_outside},
    {"nan", "a plane with one texel that is NaN", "float", {}, make_nan},
};

}  // namespace

std::span<const MapKind> map_kinds() { return all_kinds; }

const MapKind* find_map_kind(std::string_view name) {
    for (const MapKind& kind : all_kinds)
        if (kind.name == name) return &kind;
    return nullptr;
}

}  // namespace quadrel::sweep
