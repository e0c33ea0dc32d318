// quadrel-lod-table: which rule for the level of detail, and which bias, comes nearest to the
// integral over the pixel, as a Markdown table.
//
//     quadrel-lod-table [SIZE [SCENE...]]
//
// Every scene is drawn in SIZE x SIZE pixels (96), with the judge's hits in both images, so that
// what differs is how maps are filtered. Figures are root mean squares of R, G and B over the
// pixels that are covered as a whole, colours cut at 1, less what the integral's own standard
// errors account for. Heights decide normals and shadows, colours the rest: `all` maps are
// filtered, or `colours` (gloss, emission and environment, too) and heights read at level 0.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <vector>

#include "quadrel/num/math.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::bench {
namespace {

/// How hardware gets from gradients to a level.
struct Rule {
    const char* name;
    Hardware hardware;
};

constexpr Rule rules[] = {{"exact", Hardware::exact},
                          {"d3d", Hardware::d3d},
                          {"vulkan-min", Hardware::vulkan_min},
                          {"llvmpipe", Hardware::llvmpipe},
                          {"swiftshader", Hardware::swiftshader}};
constexpr float biases[] = {-3, -2, -1.5f, -1, -0.5f, 0, 0.5f, 1};
constexpr const char* channels[] = {"R", "G", "B"};

/// What a row of the table stands for.
struct Way {
    const char* maps;       ///< all are filtered, or colours alone, and heights read at level 0
    const char* gradients;  ///< the footprint that colours are filtered with
    Rule rule;

    bool filters_heights() const { return std::string_view(maps) == "all"; }
};

std::vector<Way> ways() {
    std::vector<Way> all;
    for (const char* maps : {"all", "colours"})
        for (const char* gradients : {"undisplaced", "displaced"})
            for (const Rule& rule : rules) all.push_back({maps, gradients, rule});
    return all;
}

SamplerState filtered(SamplerState sampler, const Rule& rule, float bias) {
    const HardwareModel model = hardware_model(rule.hardware);
    sampler.mag = sampler.min = Filter::linear;
    sampler.mip = MipFilter::linear;
    sampler.lod_bias = bias;
    sampler.lod_form = model.lod_form;
    sampler.lod_bits = model.lod_bits;
    sampler.weight_bits = model.weight_bits;
    sampler.quad_lod = model.quad_lod ? 1 : 0;
    return sampler;
}

/// The judge's hits; maps filtered trilinearly by the rule. Attributes stay exact.
Scene filtered(Scene scene, const Way& way, float bias) {
    for (Material& material : scene.materials) {
        for (auto& [slot, texture] : material.textures) {
            texture.sampler = filtered(texture.sampler, way.rule, bias);
            if (slot == "height" && !way.filters_heights()) texture.sampler.mip = MipFilter::none;
        }
        material.trace.id = "oracle-bilinear";
        material.trace.parameters.clear();
        material.shade.parameters["gradients"] = std::string(way.gradients);
    }
    if (scene.environment)
        scene.environment->sampler = filtered(scene.environment->sampler, way.rule, bias);
    return scene;
}

Film integral_of(const Scene& scene) {
    RenderOptions options;
    options.integral = IntegralOptions{1024, 0.008};
    return render(scene, options);
}

Film image_of(const Scene& scene) {
    RenderOptions options;
    options.channels = {"R", "G", "B"};
    return render(scene, options);
}

double cut(float x) { return std::min(static_cast<double>(x), 1.0); }

struct Difference {
    double squares = 0, noise = 0;
    int values = 0;

    double rms() const { return std::sqrt(std::max(0.0, squares - noise) / std::max(values, 1)); }
};

Difference difference(const Film& image, const Film& integral) {
    Difference sum;
    for (const char* name : channels) {
        const Plane &drawn = *image.find(name), &mean = *integral.find(name),
                    &error = *integral.find(std::string("integral.error.") + name);
        for (std::size_t i = 0; i < drawn.bits.size(); ++i) {
            if (integral.find("A")->as_float(i) != 1.0f) continue;
            const double off = cut(drawn.as_float(i)) - cut(mean.as_float(i));
            const double by_chance = error.as_float(i);
            sum.squares += off * off;
            sum.noise += by_chance * by_chance;
            ++sum.values;
        }
    }
    return sum;
}

void print_header() {
    std::string line = "| scene | filtered maps | gradients | rule |", rule = "|---|---|---|---|";
    for (const float bias : biases) {
        line += fmt::format(" {:+g} |", bias);
        rule += "---|";
    }
    std::cout << line << '\n' << rule << '\n';
}

void print_row(const std::string& scene, const Way& way, const std::vector<Difference>& row) {
    std::cout << fmt::format("| {} | {} | {} | {} |", scene, way.maps, way.gradients,
                             way.rule.name);
    for (const Difference& d : row) std::cout << fmt::format(" {:.2f} |", 100 * d.rms());
    std::cout << std::endl;
}

/// Rows by way, columns by bias.
using Table = std::vector<std::vector<Difference>>;

/// Rows of a scene, which are added to those of all scenes, each with the same weight.
void print_scene(const std::string& name, int size, Table& total) {
    const Scene scene = load_scene(name, {fmt::format("size=[{},{}]", size, size)});
    const Film integral = integral_of(scene);
    std::size_t next = 0;
    for (const Way& way : ways()) {
        std::vector<Difference> row, &sums = total[next++];
        for (std::size_t i = 0; i < std::size(biases); ++i) {
            const Difference d = difference(image_of(filtered(scene, way, biases[i])), integral);
            row.push_back(d);
            sums[i].squares += d.squares / std::max(d.values, 1);
            sums[i].noise += d.noise / std::max(d.values, 1);
            sums[i].values += 1;
        }
        print_row(name, way, row);
    }
}

void print_table(int size, const std::vector<std::string>& scenes) {
    print_header();
    const std::vector<Way> rows = ways();
    Table total(rows.size(), std::vector<Difference>(std::size(biases)));
    for (const std::string& scene : scenes) print_scene(scene, size, total);
    for (std::size_t i = 0; i < rows.size(); ++i) print_row("all", rows[i], total[i]);
}

}  // namespace
}  // namespace quadrel::bench

int main(int argc, char** argv) try {
    const int size = argc > 1 ? std::stoi(argv[1]) : 96;
    std::vector<std::string> scenes(argv + std::min(argc, 2), argv + argc);
    if (scenes.empty())
        scenes = {"bricks-45", "stones-45",  "dunes-70",     "city-day",
                  "spikes-60", "text-plate", "thesis-teapot"};
    quadrel::bench::print_table(size, scenes);
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
