// What implementations that a budget permits may differ by at most, as far as a search finds it:
// all of it lies within the ranges, what goes beyond the budget does not, and the search gets far
// enough to say how wide right ranges must be.
#include "render/ranges/extremes.hpp"

#include <cstdlib>
#include <span>

#include "effort.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/legal.hpp"
#include "quadrel/scene/load.hpp"
#include "render/films.hpp"

namespace quadrel::render_tests {
namespace {

const std::vector<std::string> extreme_channels = {"uv.U",  "uv.V",  "K.U",   "K.V", "lod.lambda",
                                                   "hit.U", "hit.V", "hit.s", "N.X", "N.Y",
                                                   "N.Z",   "R",     "G",     "B"};
constexpr SearchEffort little_effort{3, 6, 5};

/// What was found of quads of a scene, beside their ranges.
struct ExtremeVerdict {
    std::vector<std::string> channels;
    std::size_t values = 0, outside = 0;
    std::string first;  ///< of those outside
    /// Widths that were found over those of the ranges, where the range is one and finite:
    /// [channel][pixel].
    std::vector<std::vector<double>> reached;

    double reached_on_average(const std::string& channel) const {
        const auto c =
            static_cast<std::size_t>(std::ranges::find(channels, channel) - channels.begin());
        double sum = 0;
        for (const double part : reached[c]) sum += part;
        return sum / static_cast<double>(reached[c].size());
    }
};

void judge_pixel(ExtremeVerdict& verdict, const Film& ranges, FoundPixel& pixel, std::size_t c) {
    const std::string& name = verdict.channels[c];
    const std::size_t i = ranges.index(pixel.x, pixel.y);
    const auto end = [&](const char* prefix) { return ranges.find(prefix + name)->as_float(i); };
    const LegalRange range{end("gpu.lo."), end("gpu.hi."),
                           ranges.find("gpu.paths." + name)->bits[i], end("gpu.gap.lo."),
                           end("gpu.gap.hi.")};
    for (const float value : pixel.values[c]) {
        ++verdict.values;
        if (legal_verdict(range, static_cast<double>(value), 1, INFINITY) != LegalVerdict::fail)
            continue;
        if (verdict.outside++ == 0)
            verdict.first =
                fmt::format("{} at {},{}: {} is not in {} to {} (gap {} to {})", name, pixel.x,
                            pixel.y, value, range.lo, range.hi, range.gap_lo, range.gap_hi);
    }
    const double width = static_cast<double>(range.hi) - static_cast<double>(range.lo);
    if (range.paths == 1 && width > 0 && std::isfinite(width))
        verdict.reached[c].push_back(spread_of(pixel.values[c]).width / width);
}

Film ranges_of(const Scene& scene, const Window& window, const std::string& limits,
               const std::vector<std::string>& channels = extreme_channels) {
    RenderOptions options;
    options.channels = channels;
    options.window = window;
    options.limits = limits;
    return render(scene, options);
}

/// Of the ranges' window; the search goes by `limits`.
ExtremeVerdict extreme_verdict(const Scene& scene, const Film& ranges, const std::string& limits,
                               const SearchEffort& effort,
                               const std::vector<std::string>& channels = extreme_channels) {
    ExtremeVerdict verdict;
    verdict.channels = channels;
    verdict.reached.resize(channels.size());
    for (FoundPixel& pixel : Extremes(scene, channels, limits, effort).search(ranges.window))
        for (std::size_t c = 0; c < channels.size(); ++c) judge_pixel(verdict, ranges, pixel, c);
    return verdict;
}

struct ExtremePlace {
    const char* scene;
    Window window;
};
const ExtremePlace on_bricks{"bricks-45", {480, 192, 482, 194}};

TEST(Extremes, LieWithinTheRanges) {
    const ExtremePlace texture{"sampler-min-linear-mipmap-linear", {40, 40, 44, 44}};
    struct Case {
        ExtremePlace place;
        const char* limits;
    };
    const Case cases[] = {{texture, "gl"},
                          {on_bricks, "gl"},
                          {texture, "vulkan"},
                          {texture, "d3d"},
                          {on_bricks, "vulkan"},
                          {on_bricks, "d3d"},
                          {on_bricks, "gl,rho=exact"},
                          {{"stones-45", {160, 320, 162, 322}}, "gl"},
                          {{"thesis-quad", {200, 200, 202, 202}}, "gl"}};
    for (const auto& [place, limits] : std::span(cases, test::sanitized ? 2 : std::size(cases))) {
        const Scene scene = load_scene(place.scene);
        const ExtremeVerdict verdict =
            extreme_verdict(scene, ranges_of(scene, place.window, limits), limits, little_effort);
        EXPECT_GT(verdict.values, 50000u) << place.scene;
        EXPECT_EQ(verdict.outside, 0u) << place.scene << ", " << limits << ": " << verdict.first;
    }
}

/// One quad of each row; a few rows here, all of them where the environment asks for it.
TEST(Extremes, LieWithinTheRangesOfRows) {
    const bool all = std::getenv("QUADREL_ALL_EXTREMES") != nullptr;
    const int step = all ? 1 : test::sanitized ? 60 : 12;
    int number = 0, rows = 0;
    for (const std::string& name : installed_scenes()) {
        if (!name.starts_with("rows/") || ++number % step != 0) continue;
        const Scene scene = load_scene(name, {"samples=1"});
        const int x = scene.width / 2 & ~1, y = scene.height / 2 & ~1;
        try {
            const ExtremeVerdict verdict = extreme_verdict(
                scene, ranges_of(scene, {x, y, x + 2, y + 2}, "gl"), "gl", {3, 4, 3});
            EXPECT_EQ(verdict.outside, 0u) << name << ": " << verdict.first;
            rows += verdict.values > 0;
        } catch (const UsageError&) {
            continue;  // a stage that does not run on ranges
        }
    }
    EXPECT_GT(rows, all ? 150 : test::sanitized ? 1 : 10);
}

/// Each error, larger than the budget that ranges are made for.
TEST(Extremes, BeyondWhatIsPermittedAreFound) {
    const Scene scene = load_scene(on_bricks.scene);
    const Film ranges = ranges_of(scene, on_bricks.window, "gl");
    for (const std::string error : {"evaluation=1e-6", "plane=1e-3", "snapping=0.5", "address=0.1",
                                    "lod=0.5", "filtered=0.1"}) {
        if (test::sanitized && error != "evaluation=1e-6") continue;
        const ExtremeVerdict verdict = extreme_verdict(scene, ranges, "gl," + error, little_effort);
        EXPECT_GT(verdict.outside, 0u) << error;
    }
}

/// All differences of an implementation are along the same row and column: neither do ranges hold
/// those that take P along one row and uv along the other, nor may they forget a choice.
TEST(Extremes, AreAlongOneRowAndColumn) {
    const Scene scene = load_scene(on_bricks.scene);
    const std::vector<std::string> channels = {"K.U", "K.V", "dUVdx.U", "dUVdy.V"};
    const auto outside = [&](const std::string& ranges, const std::string& limits) {
        const std::string precise = "gl,evaluation=1e-7,derivatives=";
        return extreme_verdict(scene,
                               ranges_of(scene, on_bricks.window, precise + ranges, channels),
                               precise + limits, {1, 20, 10}, channels)
            .outside;
    };
    EXPECT_EQ(outside("quad", "quad"), 0u);
    EXPECT_GT(outside("quad", "each"), 0u);
    EXPECT_GT(outside("exact", "quad"), 0u);
    EXPECT_EQ(outside("each", "each"), 0u);
}

/// Colours of sRGB8 are moved as far as decoding may be off, and no further.
TEST(Extremes, OfDecodingLieWithinTheRanges) {
    const Scene scene = load_scene("sampler-wrap-repeat");
    const Window window{8, 40, 12, 42};
    const Film ranges = ranges_of(scene, window, "gl,srgb=0.5");
    EXPECT_EQ(extreme_verdict(scene, ranges, "gl,srgb=0.5", little_effort).outside, 0u);
    EXPECT_GT(extreme_verdict(scene, ranges, "gl,srgb=0.6", little_effort).outside, 0u);
}

/// Values that interpolation alone makes are moved nearly as far as their ranges go, those of
/// searches a good part of the way.
TEST(Extremes, GetFar) {
    if (test::sanitized) GTEST_SKIP() << "as above";
    const Scene scene = load_scene(on_bricks.scene);
    const ExtremeVerdict verdict =
        extreme_verdict(scene, ranges_of(scene, on_bricks.window, "gl"), "gl", {5, 20, 9});
    for (const char* channel : {"uv.U", "uv.V", "lod.lambda"})
        EXPECT_GT(verdict.reached_on_average(channel), 0.7) << channel;
    EXPECT_GT(verdict.reached_on_average("K.U"), 0.6) << "all of it along one row";
    for (const char* channel : {"K.V", "hit.U", "hit.V"})
        EXPECT_GT(verdict.reached_on_average(channel), 0.4) << channel;
}

TEST(Extremes, AreTheSameEachTime) {
    const Scene scene = load_scene("thesis-quad");
    const auto search = [&] {
        return Extremes(scene, {"K.U", "N.X"}, "gl", {2, 2, 2}).search({200, 200, 202, 202});
    };
    const auto once = search(), again = search();
    ASSERT_EQ(once.size(), 4u);
    ASSERT_EQ(again.size(), 4u);
    for (std::size_t p = 0; p < once.size(); ++p) EXPECT_EQ(once[p].values, again[p].values);
}

TEST(Extremes, AreRefusedWhereChannelsAreNoFloats) {
    const Scene scene = load_scene("thesis-quad");
    EXPECT_THROW(Extremes(scene, {"hit.status"}, "gl"), UsageError);
    EXPECT_THROW(Extremes(scene, {"A"}, "gl"), UsageError);
}

TEST(FoundSpread, IsWhatIsLeftWithoutTheWidestGap) {
    std::vector<float> values = {4, 1, NAN, 1.5f, 3.5f, INFINITY};
    const FoundSpread spread = spread_of(values);
    EXPECT_EQ(spread.width, 3);
    EXPECT_EQ(spread.width_less_gap, 1);
    std::vector<float> none;
    EXPECT_EQ(spread_of(none).width, 0);
    EXPECT_EQ(spread_of(none).width_less_gap, 0);
}

}  // namespace
}  // namespace quadrel::render_tests
