// quadrel-number-errors: how far a float render lies from the same render in double, as a Markdown
// table: the hit's UV, the ray step K, and the steps that the search took, over three height fields
// at four angles.
//
// A quad under relief mapping (frame-gram, linear, 256 steps), 256 x 256 pixels, at the angle
// between its normal and the view axis. Pixels count where both renders end in a hit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>

#include "quadrel/num/math.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::bench {
namespace {

struct Field {
    const char* name;
    std::vector<std::string> overrides;  ///< of bricks-45
};

const std::vector<Field>& fields() {
    static const std::vector<Field> all{
        {"bricks", {}},
        {"stones", {"textures.bricks-height.file=../textures/stones_height.exr"}},
        {"spikes", {"textures.bricks-height.file=../textures/spikes_height.exr"}}};
    return all;
}

Scene scene_at(const Field& field, double degrees) {
    const double angle = degrees * 0.017453292519943295, distance = 2.2;
    std::vector<std::string> overrides = field.overrides;
    overrides.push_back(fmt::format("camera.eye=[0,{},{}]", -distance * quadrel::sin(angle),
                                    distance * quadrel::cos(angle)));
    overrides.emplace_back("size=[256,256]");
    return load_scene("bricks-45", overrides);
}

Film draw(const Scene& scene, const char* number) {
    RenderOptions options;
    options.channels = {"hit.U", "hit.V", "hit.status", "hit.steps", "K.U", "K.V"};
    options.number = number;
    return render(scene, options);
}

/// The value that a part of all is below; 0 of none.
double quantile(std::vector<double>& values, double part) {
    if (values.empty()) return 0;
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Distance of two vector channels at a pixel.
double distance(const Film& a, const Film& b, const std::string& vector, std::size_t pixel) {
    const auto difference = [&](const char* component) {
        const std::string name = vector + "." + component;
        return static_cast<double>(a.find(name)->as_float(pixel)) -
               static_cast<double>(b.find(name)->as_float(pixel));
    };
    const double u = difference("U"), v = difference("V");
    return std::sqrt(u * u + v * v);
}

std::string row(const Field& field, int degrees) {
    const Scene scene = scene_at(field, degrees);
    const Film single = draw(scene, "float"), exact = draw(scene, "double");
    std::vector<double> uv, K;
    std::size_t steps = 0;
    constexpr std::uint32_t hit = 1;
    for (std::size_t i = 0; i < single.window.area(); ++i) {
        if (single.find("hit.status")->bits[i] != hit || exact.find("hit.status")->bits[i] != hit)
            continue;
        uv.push_back(distance(single, exact, "hit", i));
        K.push_back(distance(single, exact, "K", i));
        steps += single.find("hit.steps")->bits[i] != exact.find("hit.steps")->bits[i];
    }
    const double share =
        uv.empty() ? 0 : 100 * static_cast<double>(steps) / static_cast<double>(uv.size());
    return fmt::format("| {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.2g} |",
                       field.name, degrees, quantile(uv, 0.5), quantile(uv, 0.99), quantile(uv, 1),
                       quantile(K, 0.5), quantile(K, 0.99), share);
}

void print_table() {
    std::cout << "| heights | angle | hit UV, median | 99 % | largest | K, median | 99 % | other "
                 "steps, % |\n|---|---|---|---|---|---|---|---|\n";
    for (const Field& field : fields())
        for (const int degrees : {0, 45, 75, 85}) std::cout << row(field, degrees) << std::endl;
}

}  // namespace
}  // namespace quadrel::bench

int main() try {
    quadrel::bench::print_table();
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
