#include "picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "measure.hpp"
#include "quadrel/scene/load.hpp"
#include "quadrel/stats.hpp"

namespace quadrel::peers {
namespace {

constexpr double fov = 4;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// From the eye to the wall's middle: a unit of length fills the frame's height.
double distance() { return 0.5 / std::tan(radians(fov / 2)); }

/// Side of the quad that fills the frame at this angle, and a little more.
double side(double angle) {
    return 2.04 * distance() * std::sin(radians(fov / 2)) / std::cos(radians(angle + fov / 2));
}

/// The environment is the one of data/scenes.
constexpr const char* text = R"({{
  "quadrel": 1,
  "size": [{size}, {size}],
  "camera": {{"fov_y": {fov}, "eye": [0, 0, {distance}], "target": [0, 0, 0]}},
  "textures": {{
    "color": {{"file": "color.exr", "format": "srgb8"}},
    "height": {{"file": "height.exr", "format": "unorm16", "swizzle": "r",
               "mip": "none", "min": "linear"}},
    "gloss": {{"file": "gloss.exr", "format": "unorm8", "swizzle": "gb0r"}}
  }},
  "material": {{
    "color": "color", "height": "height", "shade": "shade-lambert",
    "ambient": [2, 2, 2], "diffuse": [0.9, 0.9, 0.9],
    "texture_matrix": {{"scale": [{side}, {side}]}}
  }},
  "objects": [{{"mesh": {{"shape": "quad", "size": {side}}},
               "transform": [{{"rotate": -{angle}, "axis": [1, 0, 0]}}]}}],
  "lights": [{{"type": "point", "space": "eye", "position": [10, 10, 0]}}],
  "environment": {{"faces": [{faces}], "format": "half"}}
}}
)";

/// Of the installed scene bricks-45.
std::string environment_faces() {
    const Scene scene = load_scene("bricks-45");
    std::string list;
    for (const auto& face : scene.environment.value().faces)
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", face.string());
    return list;
}

}  // namespace

Scene wall_scene(const std::filesystem::path& maps, double angle, int size,
                 const std::vector<std::string>& overrides) {
    static const std::string faces = environment_faces();
    const std::filesystem::path file = maps / "wall.json";
    std::ofstream(file) << fmt::format(
        text, fmt::arg("size", size), fmt::arg("fov", fov), fmt::arg("distance", distance()),
        fmt::arg("side", side(angle)), fmt::arg("angle", angle), fmt::arg("faces", faces));
    return load_scene(file, overrides);
}

Picture::Picture(Scene scene, const std::string& isa, std::vector<std::string> channels, bool skip)
    : scene_(std::move(scene)) {
    options_.skip = skip;
    options_.channels = std::move(channels);
    options_.isa = isa;
}

Time Picture::draw(int threads) {
    RenderSummary summary;
    options_.threads = threads;
    options_.summary = &summary;
    render_into(film_, scene_, options_);
    if (!loaded_) load_ = {summary.load.wall_ms, summary.load.cpu_ms};
    loaded_ = true;
    return {summary.draw.wall_ms, summary.draw.cpu_ms};
}

Time Picture::render_counting(int threads, Counting counting) {
    RenderStats stats;
    RenderOptions options = options_;
    options.threads = threads;
    options.summary = nullptr;
    options.stats = counting == Counting::nothing ? nullptr : &stats;
    options.touched = counting == Counting::touched;
    return time_of([&] { render_into(film_, scene_, options); });
}

std::map<std::string, std::uint64_t> Picture::look_ups() {
    RenderStats stats;
    RenderOptions options = options_;
    options.threads = 1;
    options.summary = nullptr;
    options.stats = &stats;
    render_into(film_, scene_, options);
    return stats.fetches_by_kind;
}

}  // namespace quadrel::peers
