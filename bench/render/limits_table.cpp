// quadrel-limits-table: how much the ranges of --limits say over whole scenes, as a Markdown table.
//
//     quadrel-limits-table [LIMITS [QUADS [SCENE...]]]
//
// LIMITS as --limits has them (gl). Of every scene of data/ (but those of data/scenes/rows), QUADS
// quads (64) are drawn, spread evenly over the frame, and judged as `compare --legal` judges a file
// of the whole frame by itself: shares of covered pixels that are ambiguous, and that are
// unconstrained. In brackets, of how many pixels no range that is right could be narrow: renders
// that the limits permit differ there by as much as makes a range wide.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <map>
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

std::vector<std::string> channels() {
    std::vector<std::string> names;
    for (const Column& column : columns())
        names.insert(names.end(), column.channels.begin(), column.channels.end());
    return names;
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

/// The covered pixels of `quads`, as one row.
Film sampled_pixels(const Scene& scene, const std::vector<Window>& quads,
                    const std::string& limits) {
    RenderOptions options;
    options.channels = channels();
    options.channels.push_back("A");
    options.limits = limits;
    Film row;
    for (const Window& quad : quads) {
        options.window = quad;
        append_covered(row, render(scene, options));
    }
    return row;
}

/// By which each channel differs over the whole frame, as `compare` says it.
std::map<std::string, double> extents_of(const Scene& scene) {
    RenderOptions options;
    options.channels = channels();
    Film frame = render(scene, options);
    const std::vector<Plane> values = frame.planes;
    for (const Plane& value : values)
        for (const char* prefix : {"gpu.lo.", "gpu.hi."}) {
            frame.planes.push_back(value);
            frame.planes.back().name = prefix + value.name;
        }
    for (const Plane& value : values) frame.add("gpu.paths." + value.name, ChannelType::uint32, 1);
    std::map<std::string, double> extents;
    for (const LegalChannelReport& channel : judge(take_apart(frame, "frame"), frame, {}).channels)
        extents[channel.name] = channel.extent;
    return extents;
}

/// The biases of all textures, by their keys in the scene file.
std::map<std::string, double> biases_of(const Scene& scene) {
    std::map<std::string, double> biases;
    for (const Material& material : scene.materials)
        for (const auto& [slot, texture] : material.textures)
            biases[texture.key] = texture.sampler.lod_bias;
    return biases;
}

/// Scenes whose renders the limits permit, too: levels of detail that all forms of rho allow, and
/// an implementation that is known.
std::vector<std::vector<std::string>> permitted(const Scene& scene, const std::string& limits) {
    const bool direct = limits.starts_with("d3d"), exact = limits.find("rho=exact") != limits.npos;
    const double lod = direct ? 0x1p-8 : 0x1p-4;
    std::vector<double> biases{-lod, lod};
    if (!direct && !exact) biases = {-lod, 0.25, 0.5};  // sqrt(2) times as long
    std::vector<std::vector<std::string>> scenes;
    for (const double bias : biases) {
        std::vector<std::string> overrides;
        for (const auto& [key, own] : biases_of(scene))
            overrides.push_back(fmt::format("{}.lod_bias={}", key, own + bias));
        scenes.push_back(overrides);
    }
    const bool interpolates = limits.find("evaluation=0") == limits.npos;
    if (limits.starts_with("gl") && interpolates && !exact)
        scenes.push_back({"hardware=\"llvmpipe\""});
    return scenes;
}

/// What there is of a channel in a pixel of the row.
struct Spread {
    double least, most;
    void include(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

class SceneShares {
  public:
    SceneShares(const std::string& name, const std::string& limits, int quads) {
        const Scene scene = load_scene(name);
        const auto windows = spread_quads(scene.width, scene.height, quads);
        extents_ = extents_of(scene);
        const auto start = std::chrono::steady_clock::now();
        row_ = sampled_pixels(scene, windows, limits);
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (row_.planes.empty() || row_.window.area() == 0)
            throw UsageError("no quad that is covered");
        for (const auto& overrides : permitted(scene, limits))
            variants_.push_back(sampled_pixels(load_scene(name, overrides), windows, ""));
    }

    std::size_t pixels() const { return row_.window.area(); }
    double milliseconds() const { return 1000 * seconds_ / static_cast<double>(pixels()); }

    /// Percent ambiguous / unconstrained (at least), of the column's worst channel of each.
    std::string text(const Column& column) const {
        double worst[3] = {};
        for (const std::string& channel : column.channels) {
            const auto shares = shares_of(channel);
            for (int k = 0; k < 3; ++k) worst[k] = std::max(worst[k], shares[k]);
        }
        return fmt::format("{:.0f} / {:.0f} ({:.0f})", worst[0], worst[1], worst[2]);
    }

  private:
    std::array<double, 3> shares_of(const std::string& name) const {
        const double extent = extents_.at(name), widest = LegalRules().widest;
        const auto plane = [&](const std::string& prefix) -> const Plane& {
            return *row_.find(prefix + name);
        };
        std::array<double, 3> counts{};
        for (std::size_t i = 0; i < pixels(); ++i) {
            const LegalRange range{plane("gpu.lo.").as_float(i), plane("gpu.hi.").as_float(i),
                                   plane("gpu.paths.").bits[i], plane("gpu.gap.lo.").as_float(i),
                                   plane("gpu.gap.hi.").as_float(i)};
            const double value = plane("").as_float(i);
            const LegalVerdict verdict = legal_verdict(range, value, extent, widest);
            if (verdict == LegalVerdict::fail) throw UsageError("a value outside of its range");
            counts[0] += verdict == LegalVerdict::ambiguous;
            counts[1] += verdict == LegalVerdict::unconstrained;
            Spread spread{value, value};
            for (const Film& variant : variants_) {
                const double other = variant.find(name)->as_float(i);
                if (legal_verdict(range, other, extent, widest) == LegalVerdict::fail)
                    throw UsageError(fmt::format("{} of a permitted render is outside", name));
                spread.include(other);
            }
            counts[2] += spread.most - spread.least > widest * extent;
        }
        for (double& count : counts) count *= 100 / static_cast<double>(pixels());
        return counts;
    }

    std::map<std::string, double> extents_;
    Film row_;
    double seconds_ = 0;
    std::vector<Film> variants_;  ///< what else is permitted, the same pixels
};

void print_header() {
    std::string line = "| scene | pixels |", rule = "|---|---|";
    for (const Column& column : columns()) {
        line += fmt::format(" {} |", column.name);
        rule += "---|";
    }
    std::cout << line << " ms a pixel |\n" << rule << "---|" << std::endl;
}

void print_scene(const std::string& name, const std::string& limits, int quads) {
    const SceneShares shares(name, limits, quads);
    std::string line = fmt::format("| {} | {} |", name, shares.pixels());
    for (const Column& column : columns()) line += fmt::format(" {} |", shares.text(column));
    std::cout << line << fmt::format(" {:.1f} |", shares.milliseconds()) << std::endl;
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
