// Images that were drawn elsewhere, and sums of errors.
#include <nlohmann/json.hpp>

#include "quadrel/error.hpp"
#include "quadrel/stats.hpp"
#include "render/errors/judged_scenes.hpp"

namespace quadrel::render_tests {
namespace {

const std::vector<std::string> port_channels{
    "A", "hit.U", "hit.V", "hit.s", "hit.status", "N", "R", "G", "B", "shadow.visibility", "K"};

/// What a port of the scene would write.
Film port(const Scene& scene) { return take(render, scene, port_channels); }

ErrorKind most_frequent(const ErrorSummary& summary) {
    const auto& kinds = summary.parts.at(0).kinds;
    return static_cast<ErrorKind>(std::ranges::max_element(kinds) - kinds.begin());
}

const ErrorSpread& spread(const ErrorSummary& summary, const std::string& channel,
                          std::size_t part = 0) {
    for (const ErrorSpread& row : summary.parts.at(part).spreads)
        if (row.channel == channel) return row;
    throw std::out_of_range(channel);
}

/// Moves hits along their rays by `by`, of the relief's depth.
void move_along(Film& film, double by) {
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        const auto move = [&](const char* name, double change) {
            Plane& plane = *film.find(name);
            plane.bits[i] =
                std::bit_cast<std::uint32_t>(static_cast<float>(plane.as_float(i) + change));
        };
        move("hit.s", by);
        move("hit.U", by * film.find("K.U")->as_float(i));
        move("hit.V", by * film.find("K.V")->as_float(i));
    }
}

/// An image of the scene is judged as the scene is.
testing::AssertionResult is_judged_as_the_scene(const Film& image, const Scene& scene) {
    const ErrorSummary drawn = measure_errors(scene), judged = measure_errors(image, scene);
    if (judged.parts.size() != 1 || judged.judged != drawn.judged)
        return testing::AssertionFailure() << "other pixels";
    if (judged.parts[0].kinds != drawn.parts[0].kinds)
        return testing::AssertionFailure() << "other kinds";
    for (const char* name : {"err.s", "err.uv", "err.normal", "err.shadow", "err.color"}) {
        const ErrorSpread &a = spread(drawn, name), &b = spread(judged, name);
        if (a.values != b.values || a.p50 != b.p50 || a.p99 != b.p99 || a.most != b.most)
            return testing::AssertionFailure() << name << ": " << a.most << ", " << b.most;
    }
    return testing::AssertionSuccess();
}

TEST(JudgedImages, AreJudgedAsTheirScene) {
    const Scene scene = judged_scene("linear", hills(), "frame-gram");
    const Film image = port(scene);
    EXPECT_TRUE(is_judged_as_the_scene(image, scene));
    for (const char* name : {"hit.s", "hit.U", "N.X", "G", "shadow.visibility"}) {
        Film other = image;
        change_plane(other, name, [](float x) { return x + 0.25f; });
        EXPECT_FALSE(is_judged_as_the_scene(other, scene)) << name;
    }
}

/// Each planted search is noticed, and for what it is.
TEST(JudgedImages, PlantedSearchesAreClassified) {
    const Scene scene = judged_scene("oracle-bilinear");
    const Film right = port(scene);
    const auto kind_with = [&](const std::function<void(Film&)>& plant) {
        Film image = right;
        plant(image);
        return most_frequent(measure_errors(image, scene));
    };
    EXPECT_EQ(kind_with([](Film&) {}), ErrorKind::same);
    EXPECT_EQ(kind_with([](Film& film) { move_along(film, -0.05); }), ErrorKind::early);
    EXPECT_EQ(kind_with([](Film& film) { move_along(film, 0.01); }), ErrorKind::late);
    EXPECT_EQ(
        kind_with([](Film& film) {  // across the rays
            const double texel = 1.0 / map_size;
            for (std::size_t i = 0; i < film.window.area(); ++i) {
                const double x = film.find("K.U")->as_float(i), y = film.find("K.V")->as_float(i),
                             length = std::sqrt(x * x + y * y);
                const auto add = [&](const char* name, double by) {
                    Plane& plane = *film.find(name);
                    plane.bits[i] =
                        std::bit_cast<std::uint32_t>(static_cast<float>(plane.as_float(i) + by));
                };
                add("hit.U", -y / length * 2 * texel);
                add("hit.V", x / length * 2 * texel);
            }
        }),
        ErrorKind::other_surface);
    EXPECT_EQ(kind_with([](Film& film) {
                  for (std::uint32_t& status : film.find("hit.status")->bits)
                      status = static_cast<std::uint32_t>(Status::floor);
                  change_plane(film, "hit.s", [](float) { return 1.0f; });
              }),
              ErrorKind::missed);
}

/// A hit where the field is never met: heights below the relief's bottom.
TEST(JudgedImages, InventedHitsAreTold) {
    const TextureReference deep =
        texture(write_texture("deep.exr", 8, [](int, int, int) { return -0.5; }));
    const Scene scene = judged_scene("oracle-bilinear", deep);
    Film image = port(scene);
    EXPECT_EQ(most_frequent(measure_errors(image, scene)), ErrorKind::same);
    move_along(image, -0.5);
    for (std::uint32_t& status : image.find("hit.status")->bits)
        status = static_cast<std::uint32_t>(Status::hit);
    EXPECT_EQ(most_frequent(measure_errors(image, scene)), ErrorKind::invented);
}

TEST(JudgedImages, AreJudgedByWhatTheyHold) {
    const Scene scene = judged_scene("linear");
    const Film image = port(scene);
    const ErrorSummary by_normal = measure_errors(with_planes(image, {"N.X", "N.Y", "N.Z"}), scene);
    EXPECT_EQ(by_normal.parts.at(0).spreads.size(), 1u);
    EXPECT_EQ(by_normal.judged, measure_errors(scene).judged);
    EXPECT_EQ(most_frequent(by_normal), ErrorKind::not_judged);
    // By UV alone late hits are late all the same.
    const ErrorSummary by_uv = measure_errors(with_planes(image, {"hit.U", "hit.V"}), scene);
    EXPECT_EQ(most_frequent(by_uv), ErrorKind::late);
    EXPECT_EQ(spread(by_uv, "err.uv").most, spread(measure_errors(scene), "err.uv").most);
    EXPECT_THROW(measure_errors(with_planes(image, {"A", "K.U"}), scene), UsageError);
    EXPECT_THROW(measure_errors(image, judged_scene("linear", hills(), "frame-gram", 16)),
                 UsageError);
    ErrorOptions options;
    options.window = Window{8, 8, 20, 30};
    EXPECT_EQ(measure_errors(image, scene, options).pixels, 12u * 22u);
    options.window = Window{8, 8, 20, 33};
    EXPECT_THROW(measure_errors(image, scene, options), UsageError);
}

/// Whatever an image holds, each pixel has a kind; where nothing was drawn it is missed.
TEST(JudgedImages, MayHoldAnything) {
    const Scene scene = judged_scene("linear");
    const Film image = port(scene);
    const auto judged = [&](const char* name,
                            const std::function<std::uint32_t(std::size_t)>& bits) {
        Film film;
        Film wild = image;
        Plane& plane = *wild.find(name);
        for (std::size_t i = 0; i < plane.bits.size(); ++i) plane.bits[i] = bits(i);
        ErrorOptions options;
        options.film = &film;
        const ErrorSummary summary = measure_errors(wild, scene, options);
        std::uint64_t pixels = 0;
        for (const std::uint64_t count : summary.parts.at(0).kinds) pixels += count;
        EXPECT_EQ(pixels, summary.covered) << name;
        EXPECT_FALSE(to_text(summary).empty());
        return most_frequent(summary);
    };
    const float wild[] = {std::nanf(""), std::numeric_limits<float>::infinity(), -1e30f, 1e9f, 0};
    for (const char* name : {"hit.U", "hit.V", "hit.s", "N.Y", "G", "shadow.visibility"})
        judged(name, [&](std::size_t i) { return std::bit_cast<std::uint32_t>(wild[i % 5]); });
    EXPECT_EQ(judged("hit.status",
                     [](std::size_t i) { return static_cast<std::uint32_t>(2 + i * 77777); }),
              ErrorKind::missed);
    EXPECT_EQ(judged("A", [](std::size_t) { return 0u; }), ErrorKind::missed);
}

/// Percentiles are those of the sorted values, shares those of counts.
testing::AssertionResult sums_up(const Film& film, const ErrorSummary& summary) {
    std::vector<float> values;
    std::array<std::uint64_t, error_kinds> kinds{};
    for (std::size_t i = 0; i < film.window.area(); ++i) {
        if (!(film.find("A")->as_float(i) > 0)) continue;
        ++kinds[film.find("err.search.kind")->bits[i]];
        if (std::isfinite(film.find("err.search.uv")->as_float(i)))
            values.push_back(film.find("err.search.uv")->as_float(i));
    }
    std::ranges::sort(values);
    const auto ranked = [&](double share) {
        return values[static_cast<std::size_t>(
            std::ceil(share * static_cast<double>(values.size())) - 1)];
    };
    const ErrorSpread& row = spread(summary, "err.search.uv", 1);
    if (row.p50 != ranked(0.5) || row.p90 != ranked(0.9) || row.p999 != ranked(0.999) ||
        row.most != values.back() || row.values != values.size())
        return testing::AssertionFailure() << "percentiles";
    if (summary.parts[1].kinds != kinds) return testing::AssertionFailure() << "kinds";
    return testing::AssertionSuccess();
}

TEST(ErrorSummaries, AreThoseOfTheirFilm) {
    const Scene scene = judged_scene("linear", fences(), "frame-gram");
    const Film film = errors_of(render, scene);
    EXPECT_TRUE(sums_up(film, summarize_errors(film)));
    EXPECT_TRUE(sums_up(film, measure_errors(scene)));
    Film other = film;
    change_plane(other, "err.search.uv", [](float x) { return 2 * x; });
    EXPECT_FALSE(sums_up(other, summarize_errors(film)));
    EXPECT_THROW(summarize_errors(with_planes(film, {"err.s"})), UsageError);
}

/// Statistics of a render count the same.
TEST(ErrorSummaries, AreCountedByStatistics) {
    Scene scene = judged_scene("linear", fences(), "frame-gram");
    const auto counted = [&](const Scene& of, const std::string& channel) {
        RenderStats stats;
        RenderOptions options;
        options.channels = {channel};
        options.stats = &stats;
        render(of, options);
        EXPECT_EQ(stats.kinds.drawn, channel == "err.kind");
        EXPECT_EQ(to_json(stats).find("other surface") != std::string::npos, channel == "err.kind");
        return stats.kinds.lanes;
    };
    EXPECT_EQ(counted(scene, "err.kind"), measure_errors(scene).parts.at(0).kinds);
    EXPECT_EQ(counted(scene, "hit.s"), decltype(KindStats::lanes){});
    Scene other = scene;
    other.materials[0].trace.parameters["steps"] = 4;
    EXPECT_NE(counted(other, "err.kind"), measure_errors(scene).parts.at(0).kinds);
}

TEST(ErrorSummaries, NameTheWorstPixels) {
    const Scene scene = judged_scene("linear", fences(), "frame-gram");
    const Film film = errors_of(render, scene);
    const ErrorSummary summary = measure_errors(scene);
    ASSERT_FALSE(summary.worst.empty());
    const WorstPixel& worst = summary.worst.front();
    EXPECT_EQ(worst.channel, "err.uv");
    EXPECT_EQ(worst.value, spread(summary, "err.uv").most);
    EXPECT_EQ(worst.value, value(film, "err.uv", worst.x, worst.y));
    EXPECT_NE(worst.command.find("quadrel probe test.json --pixel " + std::to_string(worst.x) +
                                 "," + std::to_string(worst.y)),
              std::string::npos);
}

TEST(ErrorSummaries, AreWrittenForPeopleAndTools) {
    const ErrorSummary summary = measure_errors(judged_scene("linear", fences(), "frame-gram"));
    const std::string text = to_text(summary);
    for (const char* part : {"other surface", "whole", "search", "frame", "uv (texels)",
                             "quadrel probe", "relief: frame-face, oracle-bilinear"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
    const auto json = nlohmann::json::parse(to_json(summary));
    EXPECT_EQ(json["judged"].get<std::uint64_t>(), summary.judged);
    EXPECT_EQ(json["parts"].size(), 3u);
    EXPECT_EQ(json["parts"][0]["kinds"]["late"].get<std::uint64_t>(), summary.parts[0].kinds[1]);
    // Nothing covered: a table all the same.
    Scene empty = judged_scene("linear");
    empty.objects[0].visible = false;
    const ErrorSummary none = measure_errors(empty);
    EXPECT_EQ(none.judged, 0u);
    EXPECT_FALSE(to_text(none).empty());
    EXPECT_EQ(nlohmann::json::parse(to_json(none))["covered"], 0);
}

}  // namespace
}  // namespace quadrel::render_tests
