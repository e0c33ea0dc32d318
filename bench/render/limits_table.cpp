// quadrel-limits-table: how much the ranges of --limits say over whole scenes, as a Markdown table.
//
//     quadrel-limits-table [LIMITS [QUADS [SCENE...]]]
//
// LIMITS as --limits has them (gl). Of every scene of data/ (but those of data/scenes/rows), QUADS
// quads (64) are drawn, spread evenly over the frame, and judged as `compare --legal` judges a file
// by itself: shares of covered pixels that are ambiguous, and that are unconstrained. Extents are
// those of the pixels that were drawn.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <vector>

#include "quadrel/error.hpp"
#include "quadrel/film/legal.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"

namespace quadrel::bench {
namespace {

/// What a column of the table is of: the channel of these that has most that says little.
struct Column {
    const char* name;
    std::vector<std::string> channels;
};

std::vector<Column> columns() {
    return {{"uv", {"uv.U", "uv.V"}},
            {"K", {"K.U", "K.V"}},
            {"hit.uv", {"hit.U", "hit.V"}},
            {"N", {"N.X", "N.Y", "N.Z"}},
            {"R G B", {"R", "G", "B"}}};
}

/// The upper left pixels of about `count` quads, spread over a frame.
std::vector<Window> spread_quads(int width, int height, int count) {
    const double step = std::sqrt(double(width) * height / count);
    std::vector<Window> quads;
    int row = 0;
    for (double y = step / 2; y < height; y += step, ++row) {
        const double shift = row % 2 == 0 ? 0.25 : 0.75;  // no column of quads one below the other
        for (double x = step * shift; x < width; x += step) {
            const int x0 = static_cast<int>(x) & ~1, y0 = static_cast<int>(y) & ~1;
            if (x0 + 2 <= width && y0 + 2 <= height) quads.push_back({x0, y0, x0 + 2, y0 + 2});
        }
    }
    return quads;
}

/// Appends the pixels of `from` that are covered, as one row.
void append_covered(Film& row, const Film& from) {
    const Plane& covered = *from.find("A");
    for (std::size_t p = 0; p < from.planes.size(); ++p) {
        if (row.planes.size() == p)
            row.planes.push_back({from.planes[p].name, from.planes[p].type, {}});
        for (std::size_t i = 0; i < covered.bits.size(); ++i)
            if (covered.as_float(i) > 0) row.planes[p].bits.push_back(from.planes[p].bits[i]);
    }
    const int pixels = static_cast<int>(row.planes[0].bits.size());
    row.frame = row.window = {0, 0, pixels, 1};
}

Film sampled_pixels(const Scene& scene, const std::string& limits, int quads) {
    RenderOptions options;
    options.channels = {"uv", "K", "hit.U", "hit.V", "N", "R", "G", "B", "A"};
    options.limits = limits;
    Film row;
    for (const Window& quad : spread_quads(scene.width, scene.height, quads)) {
        options.window = quad;
        append_covered(row, render(scene, options));
    }
    return row;
}

std::string shares_of(const LegalReport& report, const Column& column) {
    double ambiguous = 0, unconstrained = 0;
    for (const LegalChannelReport& channel : report.channels) {
        if (std::ranges::count(column.channels, channel.name) == 0) continue;
        const auto share = [&](LegalVerdict verdict) {
            return 100.0 * static_cast<double>(channel.count(verdict)) /
                   static_cast<double>(channel.pixels);
        };
        ambiguous = std::max(ambiguous, share(LegalVerdict::ambiguous));
        unconstrained = std::max(unconstrained, share(LegalVerdict::unconstrained));
    }
    return fmt::format("{:.0f} / {:.0f}", ambiguous, unconstrained);
}

void print_header() {
    std::string line = "| scene | pixels |", rule = "|---|---|";
    for (const Column& column : columns()) {
        line += fmt::format(" {} |", column.name);
        rule += "---|";
    }
    std::cout << line << " ms a pixel |\n" << rule << "---|" << std::endl;
}

void print_scene(const std::string& name, const std::string& limits, int quads) {
    const Scene scene = load_scene(name);
    const auto start = std::chrono::steady_clock::now();
    const Film row = sampled_pixels(scene, limits, quads);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::size_t pixels = row.window.area();
    if (pixels == 0) throw UsageError("no quad that is covered");
    const LegalReport report = judge(take_apart(row, name), row, {});
    std::string line = fmt::format("| {} | {} |", name, pixels);
    for (const Column& column : columns()) line += fmt::format(" {} |", shares_of(report, column));
    std::cout << line << fmt::format(" {:.1f} |", 1000 * seconds / static_cast<double>(pixels))
              << std::endl;
}

void print_table(const std::string& limits, int quads, const std::vector<std::string>& scenes) {
    print_header();
    for (const std::string& name : scenes) {
        try {
            print_scene(name, limits, quads);
        } catch (const UsageError& error) {
            std::cout << fmt::format("| {} | {} |", name, error.what()) << std::endl;
        }
    }
}

}  // namespace
}  // namespace quadrel::bench

int main(int argc, char** argv) try {
    const std::string limits = argc > 1 ? argv[1] : "gl";
    const int quads = argc > 2 ? std::stoi(argv[2]) : 64;
    std::vector<std::string> scenes(argv + std::min(argc, 3), argv + argc);
    if (scenes.empty()) {
        scenes = quadrel::installed_scenes();
        std::erase_if(scenes, [](const std::string& name) { return name.starts_with("rows/"); });
    }
    quadrel::bench::print_table(limits, quads, scenes);
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
