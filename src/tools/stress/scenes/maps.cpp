#include "stress/scenes/maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

#include "quadrel/film/exr.hpp"
#include "quadrel/num/math.hpp"
#include "stress/scenes/random.hpp"

namespace quadrel::stress {
namespace {

/// Place and size in texels; a source of chance that a kind may use or not.
struct Texel {
    int x, y, width, height;
    Random& random;
};

struct Kind {
    const char* name;
    float (*at)(const Texel&);
};

float ramp(const Texel& t) {
    return (static_cast<float>(t.x) + 0.5f) / static_cast<float>(t.width);
}

bool is_middle(int i, int count) { return i == count / 2; }

/// Concentric steps that rise to the middle.
float terraces(const Texel& t) {
    const int edge = std::min({t.x, t.y, t.width - 1 - t.x, t.height - 1 - t.y});
    const int most = std::max(1, std::min(t.width, t.height) / 2);
    return static_cast<float>(4 * edge / most) / 4;
}

float waves(const Texel& t) {
    constexpr double turn = 6.283185307179586;
    const double x = turn * 3 * t.x / t.width, y = turn * 2 * t.y / t.height;
    return static_cast<float>(0.5 + 0.25 * quadrel::sin(x) + 0.25 * quadrel::sin(y));
}

/// Waves of halving size and height, in 16 bits.
float fractal(const Texel& t) {
    constexpr double turn = 6.283185307179586;
    double sum = 0, height = 0.25;
    for (int octave = 1; octave <= 16; octave *= 2, height /= 2)
        sum += height * (1 + quadrel::sin(turn * octave * t.x / t.width + octave) *
                                 quadrel::sin(turn * octave * t.y / t.height + 3 * octave));
    return static_cast<float>(static_cast<int>(std::clamp(sum, 0.0, 1.0) * 65535)) / 65535;
}

/// Strokes two texels wide on a ground.
float strokes(const Texel& t) { return t.x % 8 < 2 || (t.y % 8 < 2 && t.x % 16 < 8) ? 0.9f : 0.2f; }

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

constexpr Kind sound_kinds[] = {
    {"one", [](const Texel&) { return 1.0f; }},
    {"zero", [](const Texel&) { return 0.0f; }},
    {"half", [](const Texel&) { return 0.5f; }},
    {"ramp", ramp},
    {"impulse",
     [](const Texel& t) {
         return is_middle(t.x, t.width) && is_middle(t.y, t.height) ? 1.0f : 0.0f;
     }},
    {"wall-x", [](const Texel& t) { return is_middle(t.x, t.width) ? 1.0f : 0.0f; }},
    {"wall-y", [](const Texel& t) { return is_middle(t.y, t.height) ? 1.0f : 0.0f; }},
    {"wall-diagonal", [](const Texel& t) { return t.x == t.y ? 1.0f : 0.0f; }},
    {"comb", [](const Texel& t) { return t.x % 2 == 0 ? 1.0f : 0.0f; }},
    {"checker", [](const Texel& t) { return (t.x + t.y) % 2 == 0 ? 1.0f : 0.0f; }},
    {"cliff", [](const Texel& t) { return 2 * t.x < t.width ? 0.0f : 1.0f; }},
    {"strokes", strokes},
    {"terraces", terraces},
    {"waves", waves},
    {"noise", [](const Texel& t) { return static_cast<float>(t.random.index(256)) / 255; }},
    {"fractal", fractal},
    {"beyond", [](const Texel& t) { return 1.5f * waves(t) - 0.25f; }},
    {"far-beyond", [](const Texel& t) { return (waves(t) - 0.5f) * 1e6f; }},
    {"denormal", [](const Texel& t) { return static_cast<float>(t.random.index(256)) * 1e-40f; }},
};
constexpr Kind nan_kinds[] = {
    {"nan",
     [](const Texel& t) {
         return t.random.index(16) == 0 || t.x == 1 ? no_number : 0.5f * ramp(t);
     }},
    {"infinite",
     [](const Texel& t) { return t.x == 0   ? infinite
                                 : t.x == 2 ? -infinite
                                            : waves(t); }},
};

template <std::size_t n>
std::vector<std::string> names_of(const Kind (&list)[n]) {
    std::vector<std::string> names;
    for (const Kind& kind : list) names.emplace_back(kind.name);
    return names;
}

const Kind& find_kind(const std::string& name) {
    for (const Kind& kind : nan_kinds)
        if (name == kind.name) return kind;
    return *std::find_if(std::begin(sound_kinds), std::end(sound_kinds) - 1,
                         [&](const Kind& kind) { return name == kind.name; });
}

}  // namespace

std::string MapName::file() const { return fmt::format("{}-{}x{}.exr", kind, width, height); }

const std::vector<std::string>& map_kinds() {
    static const std::vector<std::string> names = names_of(sound_kinds);
    return names;
}

const std::vector<std::string>& nan_map_kinds() {
    static const std::vector<std::string> names = names_of(nan_kinds);
    return names;
}

const std::vector<std::pair<int, int>>& map_sizes() {
    static const std::vector<std::pair<int, int>> sizes = {{16, 16}, {64, 64}, {32, 8}, {3, 5},
                                                           {33, 17}, {2, 2},   {1, 7},  {1, 1}};
    return sizes;
}

void write_map(const std::filesystem::path& folder, const MapName& map) {
    const Window window{0, 0, map.width, map.height};
    Film film{window, window, {}};
    Plane& plane = film.add("Y", ChannelType::float32);
    Random random(1, static_cast<std::uint64_t>(map.width * 1000 + map.height));
    const Kind& kind = find_kind(map.kind);
    std::size_t i = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            plane.bits[i++] = canonical_bits(
                std::bit_cast<std::uint32_t>(kind.at({x, y, map.width, map.height, random})));
    write_exr(folder / map.file(), film, {});
}

void write_maps(const std::filesystem::path& folder) {
    for (const auto* names : {&map_kinds(), &nan_map_kinds()})
        for (const std::string& kind : *names)
            for (const auto& [width, height] : map_sizes())
                write_map(folder, {kind, width, height});
}

}  // namespace quadrel::stress
