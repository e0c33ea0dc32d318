// quadrel-lod-table: which rule for the level of detail, and which bias, comes nearest to the
// integral over the pixel, as a Markdown table.
//
//     quadrel-lod-table [SIZE [SCENE...]]
//
// Every scene is drawn in SIZE x SIZE pixels (96), with the judge's hits in both images, so that
// what differs is how maps are filtered. Figures are root mean squares of R, G and B over the
// pixels that are covered as a whole, colours cut at 1, less what the integral's own standard
// errors account for. The rule of one is told from that of another on minified maps alone.
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
constexpr float biases[] = {-1, -0.75f, -0.5f, -0.25f, 0, 0.25f, 0.5f, 1};
constexpr const char* channels[] = {"R", "G", "B"};

template <class Visit>
void for_each_sampler(Scene& scene, const Visit& visit) {
    for (Material& material : scene.materials)
        for (auto& [slot, texture] : material.textures) visit(texture.sampler);
    if (scene.environment) visit(scene.environment->sampler);
}

/// The judge's hits; maps filtered trilinearly by the rule, with the footprint that `gradients`
/// names. Attributes stay exact.
Scene filtered(Scene scene, const Rule& rule, float bias, const char* gradients) {
    const HardwareModel model = hardware_model(rule.hardware);
    for_each_sampler(scene, [&](SamplerState& sampler) {
        sampler.mag = sampler.min = Filter::linear;
        sampler.mip = MipFilter::linear;
        sampler.lod_bias = bias;
        sampler.lod_form = model.lod_form;
        sampler.lod_bits = model.lod_bits;
        sampler.weight_bits = model.weight_bits;
        sampler.quad_lod = model.quad_lod ? 1 : 0;
    });
    for (Material& material : scene.materials) {
        material.trace.id = "oracle-bilinear";
        material.trace.parameters.clear();
        material.shade.parameters["gradients"] = std::string(gradients);
    }
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
    std::string line = "| scene | gradients | rule |", rule = "|---|---|---|";
    for (const float bias : biases) {
        line += fmt::format(" {:+g} |", bias);
        rule += "---|";
    }
    std::cout << line << '\n' << rule << '\n';
}

/// Rows of a scene, and of all scenes together in `total`, in the same order.
void print_scene(const std::string& name, int size, std::vector<Difference>& total) {
    const Scene scene = load_scene(name, {fmt::format("size=[{},{}]", size, size)});
    const Film integral = integral_of(scene);
    std::size_t next = 0;
    for (const char* gradients : {"undisplaced", "displaced"})
        for (const Rule& rule : rules) {
            std::cout << fmt::format("| {} | {} | {} |", name, gradients, rule.name);
            for (const float bias : biases) {
                const Difference d =
                    difference(image_of(filtered(scene, rule, bias, gradients)), integral);
                std::cout << fmt::format(" {:.2f} |", 100 * d.rms());
                if (total.size() <= next) total.resize(next + 1);
                total[next].squares += d.squares / std::max(d.values, 1);
                total[next].noise += d.noise / std::max(d.values, 1);
                total[next++].values += 1;
            }
            std::cout << std::endl;
        }
}

void print_total(const std::vector<Difference>& total) {
    std::size_t next = 0;
    for (const char* gradients : {"undisplaced", "displaced"})
        for (const Rule& rule : rules) {
            std::cout << fmt::format("| all | {} | {} |", gradients, rule.name);
            for (std::size_t i = 0; i < std::size(biases); ++i)
                std::cout << fmt::format(" {:.2f} |", 100 * total[next++].rms());
            std::cout << '\n';
        }
}

void print_table(int size, const std::vector<std::string>& scenes) {
    print_header();
    std::vector<Difference> total;
    for (const std::string& scene : scenes) print_scene(scene, size, total);
    print_total(total);
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
