// quadrel-limits-table: how much the ranges of --limits say over whole scenes, as a Markdown table.
//
//     quadrel-limits-table [LIMITS [QUADS [--search] [SCENE...]]]
//
// LIMITS as --limits has them (gl). Of every scene of data/ (but those of data/scenes/rows), QUADS
// quads (64) are drawn, spread evenly over the frame, and judged as `compare --legal` judges a file
// of the whole frame by itself: shares of covered pixels that are ambiguous, and that are
// unconstrained. In brackets, what is unavoidable, since implementations that the limits permit
// (src/render/ranges/extremes.hpp) differ by as much: of how many pixels no right range could be
// narrow and one, and of how many none could be narrow, whatever gap it has. A scene in which
// permitted values lie outside of their ranges has the first of them in place of figures. With
// --search, what is in brackets alone, which takes no ranges. With QUADREL_LIMITS_PIXELS in the
// environment, a line per pixel and channel on the other stream.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <vector>

#include "quadrel/error.hpp"
#include "quadrel/film/legal.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/load.hpp"
#include "render/ranges/extremes.hpp"

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

/// Of a channel, how many pixels its ranges say little of, and of how many no right range could say
/// more.
struct Shares {
    double ambiguous = 0, unconstrained = 0;  ///< by the ranges
    double not_one = 0;                       ///< narrow, but for gaps at best
    double wide = 0;                          ///< wide, whatever gap there is

    void include_worst(const Shares& other) {
        for (double Shares::*share :
             {&Shares::ambiguous, &Shares::unconstrained, &Shares::not_one, &Shares::wide})
            this->*share = std::max(this->*share, other.*share);
    }
};

class SceneShares {
  public:
    SceneShares(const std::string& name, const std::string& limits, int quads, bool with_ranges)
        : scene_(load_scene(name)), extents_(extents_of(scene_)), with_ranges_(with_ranges) {
        options_.channels = names_;
        options_.channels.emplace_back("A");
        options_.limits = limits;
        Extremes extremes(scene_, names_, limits);
        const auto windows = spread_quads(scene_.width, scene_.height, quads);
        counts_.resize(names_.size());
        for (const Window& window : windows) judge_quad(window, extremes);
        if (pixels_ == 0) throw UsageError("no quad that is covered");
    }

    std::size_t pixels() const { return pixels_; }
    /// Of ranges, and of the search, a pixel.
    double milliseconds() const { return 1000 * seconds_ / static_cast<double>(pixels_); }
    double search_milliseconds() const {
        return 1000 * search_seconds_ / static_cast<double>(pixels_);
    }
    std::uint64_t implementations() const { return implementations_; }

    /// Percent, of the column's worst channel of each.
    Shares of(const Column& column) const {
        Shares worst;
        for (std::size_t c = 0; c < names_.size(); ++c)
            if (std::ranges::count(column.channels, names_[c]) != 0)
                worst.include_worst(percent(counts_[c]));
        return worst;
    }

  private:
    Shares percent(Shares counts) const {
        for (double Shares::*share :
             {&Shares::ambiguous, &Shares::unconstrained, &Shares::not_one, &Shares::wide})
            counts.*share *= 100 / static_cast<double>(pixels_);
        return counts;
    }

    void judge_quad(const Window& window, Extremes& extremes) {
        using Clock = std::chrono::steady_clock;
        const auto seconds = [](Clock::time_point since) {
            return std::chrono::duration<double>(Clock::now() - since).count();
        };
        auto start = Clock::now();
        options_.window = window;
        const Film ranges = with_ranges_ ? render(scene_, options_) : Film();
        seconds_ += seconds(start);
        start = Clock::now();
        std::vector<FoundPixel> pixels = extremes.search(window);
        search_seconds_ += seconds(start);
        for (FoundPixel& pixel : pixels) {
            ++pixels_;
            implementations_ = pixel.values.front().size();
            for (std::size_t c = 0; c < pixel.values.size(); ++c) judge_pixel(ranges, pixel, c);
        }
    }

    void judge_pixel(const Film& ranges, FoundPixel& pixel, std::size_t c) {
        const double most = LegalRules().widest * extents_.at(names_[c]);
        if (with_ranges_) judge_range(ranges, pixel, c);
        const FoundSpread spread = spread_of(pixel.values[c]);
        counts_[c].not_one += spread.width > most;
        counts_[c].wide += spread.width_less_gap > most;
        if (std::getenv("QUADREL_LIMITS_PIXELS") != nullptr)
            fmt::print(stderr, "{} at {},{}: found {} wide, {} less its widest gap; wide is {}\n",
                       names_[c], pixel.x, pixel.y, spread.width, spread.width_less_gap, most);
    }

    void judge_range(const Film& ranges, FoundPixel& pixel, std::size_t c) {
        const std::string& name = names_[c];
        const double extent = extents_.at(name), widest = LegalRules().widest;
        const std::size_t i = ranges.index(pixel.x, pixel.y);
        const auto plane = [&](const std::string& prefix) -> const Plane& {
            return *ranges.find(prefix + name);
        };
        const LegalRange range{plane("gpu.lo.").as_float(i), plane("gpu.hi.").as_float(i),
                               plane("gpu.paths.").bits[i], plane("gpu.gap.lo.").as_float(i),
                               plane("gpu.gap.hi.").as_float(i)};
        const float value = plane("").as_float(i);
        pixel.values[c].push_back(value);
        Shares& counts = counts_[c];
        const LegalVerdict verdict = legal_verdict(range, value, extent, widest);
        counts.ambiguous += verdict == LegalVerdict::ambiguous;
        counts.unconstrained += verdict == LegalVerdict::unconstrained;
        for (const float other : pixel.values[c])
            if (legal_verdict(range, other, extent, widest) == LegalVerdict::fail)
                throw UsageError(fmt::format("{} at {},{} may be {}, which is not in {} to {}",
                                             name, pixel.x, pixel.y, other, range.lo, range.hi));
        if (std::getenv("QUADREL_LIMITS_PIXELS") != nullptr)
            fmt::print(stderr, "{} at {},{}: range {} wide, {} less its gap\n", name, pixel.x,
                       pixel.y, range.hi - range.lo,
                       range.hi - range.lo - std::max(0.0f, range.gap_hi - range.gap_lo));
    }

    Scene scene_;
    std::map<std::string, double> extents_;
    bool with_ranges_;
    std::vector<std::string> names_ = channels();
    RenderOptions options_;
    double seconds_ = 0, search_seconds_ = 0;
    std::size_t pixels_ = 0;
    std::uint64_t implementations_ = 0;
    std::vector<Shares> counts_;  ///< a channel
};

/// Whether `compare` would let the channels pass: it does, it could not whatever right ranges there
/// were, or neither is known.
const char* target(const Shares& shares, bool with_ranges) {
    const LegalRules rules;
    const double ambiguous = 100 * rules.most_ambiguous,
                 unconstrained = 100 * rules.most_unconstrained;
    if (with_ranges && shares.ambiguous <= ambiguous && shares.unconstrained <= unconstrained)
        return "met";
    const bool beyond = shares.wide > unconstrained || shares.not_one > ambiguous + unconstrained;
    return beyond ? "impossible" : "open";
}

void print_header() {
    std::string line = "| scene | pixels |", rule = "|---|---|";
    for (const Column& column : columns()) {
        line += fmt::format(" {} |", column.name);
        rule += "---|";
    }
    std::cout << line << " N, R G B | ms per pixel | renders |\n"
              << rule << "---|---|---|" << std::endl;
}

void print_scene(const std::string& name, const std::string& limits, int quads, bool with_ranges) {
    const SceneShares shares(name, limits, quads, with_ranges);
    std::string line = fmt::format("| {} | {} |", name, shares.pixels());
    std::vector<std::string> targets;
    for (const Column& column : columns()) {
        const Shares of = shares.of(column);
        const std::string by_ranges =
            with_ranges ? fmt::format("{:.0f} / {:.0f} ", of.ambiguous, of.unconstrained) : "";
        line += fmt::format(" {}({:.0f} / {:.0f}) |", by_ranges, of.not_one, of.wide);
        targets.emplace_back(target(of, with_ranges));
    }
    std::cout << line
              << fmt::format(" {}, {} | {:.0f} + {:.0f} | {} |", targets[targets.size() - 2],
                             targets.back(), shares.milliseconds(), shares.search_milliseconds(),
                             shares.implementations())
              << std::endl;
}

void print_table(const std::string& limits, int quads, bool with_ranges,
                 const std::vector<std::string>& scenes) {
    print_header();
    for (const std::string& name : scenes) {
        try {
            print_scene(name, limits, quads, with_ranges);
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
    const bool with_ranges = std::erase(scenes, "--search") == 0;
    if (scenes.empty()) {
        scenes = quadrel::installed_scenes();
        std::erase_if(scenes, [](const std::string& name) { return name.starts_with("rows/"); });
    }
    quadrel::bench::print_table(limits, quads, with_ranges, scenes);
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
