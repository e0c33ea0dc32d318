// quadrel-relief-errors [ROW]...: how late and how early searches are on the bilinear field, and
// what they cost, as a Markdown table. A ROW is an id and parameters: "linear steps=32". Without
// rows, a choice of all classes.
//
// 4000 random rays a figure, in double, over maps of 128 x 128 texels that repeat, a tenth of a
// tile deep, at 45, 70 and 85 degrees, level 0, against texel-exact. "Late" and "early": further
// than one texel beyond or before the first hit, measured in the plane.
#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <functional>

#include "quadrel/error.hpp"
#include "quadrel/num/math.hpp"
#include "relief/fragments.hpp"

namespace quadrel::bench {
namespace {

constexpr int texels = 128, rays = 4000;
constexpr double depth = 0.1;
constexpr int angles[] = {45, 70, 85};

const std::vector<std::string> standard_rows{
    "linear steps=32",
    "linear steps=128",
    "pom steps_grazing=32 steps_normal=32",
    "relief-binary steps=15 binary_steps=6",
    "cone-rabbid",
    "cone-step",
    "cone-robust",
    "cone-robust-exact",
    "relaxed-cone",
    "relaxed-cone@published",
    "relaxed-cone-exact",
    "texel-exact",
    "max-mip",
    "cone-cell",
    "rmq-leap",
    "ddm",
};

/// Tables by direction, at some resolutions.
const std::vector<std::string> table_rows{
    "ddm bake.columns=32 bake.slices=4 bake.directions=8",
    "ddm bake.columns=64 bake.slices=8 bake.directions=8",
    "ddm bake.columns=128 bake.slices=8 bake.directions=8",
    "ddm bake.columns=64 bake.slices=8 bake.directions=16",
    "gdm bake.columns=32 bake.slices=4 bake.directions=9",
    "gdm bake.columns=64 bake.slices=4 bake.directions=9",
    "gdm bake.columns=128 bake.slices=4 bake.directions=9",
    "gdm bake.columns=64 bake.slices=8 bake.directions=9",
    "gdm bake.columns=64 bake.slices=4 bake.directions=17",
    "vdm bake.columns=32 bake.directions=9 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=9 bake.curvatures=1",
    "vdm bake.columns=128 bake.directions=9 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=17 bake.curvatures=1",
    "vdm bake.columns=64 bake.directions=33 bake.curvatures=1",
};

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

struct NamedMap {
    const char* name;
    std::function<double(int x, int y)> height;
};

const std::vector<NamedMap>& maps() {
    static std::uint64_t state = 1;
    static const std::vector<NamedMap> all{
        {"fractal", fractal},
        {"spikes", [](int, int) { return random(state) < 1.0 / 128 ? 1.0 : 0.0; }},
        {"walls", [](int x, int y) { return x % 16 == 0 || y % 16 == 0 ? 1.0 : 0.0; }},
        {"checker", [](int x, int y) { return (x / 8 + y / 8) % 2 == 0 ? 1.0 : 0.0; }},
    };
    return all;
}

std::shared_ptr<const Texture> make_map(const NamedMap& map) {
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

/// Per cent late and early, mean distance in texels, look-ups a ray, memory of baked maps where the
/// row says how they are baked.
struct Figures {
    double late = 0, early = 0, distance = 0, fetches = 0, mebibytes = 0;
};

Figures measure(Fragments& fragments, const Row& row, const std::vector<double>& truth) {
    Figures sum;
    fragments.run(row);
    for (int lane = 0; lane < rays; ++lane) {
        const double Ku = fragments.real(Value::K, lane, 0), Kv = fragments.real(Value::K, lane, 1);
        const double by = (fragments.real(Value::hit_s, lane) - truth[std::size_t(lane)]) *
                          std::sqrt(Ku * Ku + Kv * Kv) * texels;
        sum.late += by > 1;
        sum.early += by < -1;
        sum.distance += std::fabs(by);
        sum.fetches += fragments.integer(Value::hit_fetches, lane);
    }
    return {100 * sum.late / rays, 100 * sum.early / rays, sum.distance / rays, sum.fetches / rays,
            row.baking.empty() ? 0 : fragments.baked_mebibytes()};
}

std::string number(double x) {
    if (x < 0.005) return "0";
    return x < 99.5 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x);
}

/// One cell of the table: a figure at all angles.
std::string cell(const std::vector<Figures>& figures, double Figures::*figure) {
    std::string text;
    for (const Figures& f : figures) text += (text.empty() ? "" : " / ") + number(f.*figure);
    return text;
}

/// Without the lines that are all zero.
void print_row(const std::string& name, const std::vector<std::vector<Figures>>& a_map) {
    const std::pair<const char*, double Figures::*> lines[] = {{"late %", &Figures::late},
                                                               {"early %", &Figures::early},
                                                               {"mean texels", &Figures::distance},
                                                               {"look-ups", &Figures::fetches}};
    const double mebibytes = a_map.at(0).at(0).mebibytes;
    const std::string memory = mebibytes > 0 ? fmt::format(", {:.2g} MiB", mebibytes) : "";
    bool first = true;
    for (const auto& [title, figure] : lines) {
        std::string cells;
        bool zero = true;
        for (const auto& figures : a_map) {
            cells += fmt::format(" {} |", cell(figures, figure));
            for (const Figures& f : figures) zero &= number(f.*figure) == "0";
        }
        if (zero) continue;
        fmt::print("| {} | {} |{}\n", first ? "`" + name + "`" + memory : "", title, cells);
        first = false;
    }
}

void print_table(const std::vector<Row>& rows) {
    fmt::print("| search | |");
    for (const NamedMap& map : maps()) fmt::print(" {} |", map.name);
    fmt::print("\n|---|---|");
    for (std::size_t i = 0; i < maps().size(); ++i) fmt::print("---|");
    fmt::print("\n");
    std::vector<std::vector<std::vector<Figures>>> all(rows.size());
    SamplerState sampler;
    sampler.mip = MipFilter::none;
    const Row exact("texel-exact");
    for (const NamedMap& map : maps()) {
        const auto texture = make_map(map);
        Fragments fragments(rays, depth);
        fragments.bind(*texture, sampler);
        for (auto& row : all) row.emplace_back();
        for (const int angle : angles) {
            set_rays(fragments, angle);
            fragments.run(exact);
            std::vector<double> truth;
            for (int lane = 0; lane < rays; ++lane)
                truth.push_back(fragments.real(Value::hit_s, lane));
            for (std::size_t i = 0; i < rows.size(); ++i)
                all[i].back().push_back(measure(fragments, rows[i], truth));
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) print_row(rows[i].text, all[i]);
}

}  // namespace
}  // namespace quadrel::bench

int main(int argc, char** argv) {
    using namespace quadrel;
    try {
        std::vector<std::string> texts(argv + 1, argv + argc);
        if (texts.empty()) texts = bench::standard_rows;
        if (texts == std::vector<std::string>{"--tables"}) texts = bench::table_rows;
        std::vector<bench::Row> rows;
        for (const std::string& text : texts) rows.emplace_back(text);
        bench::print_table(rows);
    } catch (const UsageError& error) {
        fmt::print(stderr, "quadrel-relief-errors: {}\n", error.what());
        return static_cast<int>(ExitCode::usage);
    } catch (const std::exception& error) {
        fmt::print(stderr, "quadrel-relief-errors: {}\n", error.what());
        return static_cast<int>(ExitCode::input);
    }
    return 0;
}
