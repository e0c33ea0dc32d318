// How far a run is from the truth: the figures of `quadrel errors`, of the search and of what is
// drawn.
#include "sweep/run_error.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "quadrel/scene/load.hpp"
#include "sweep/plan_files.hpp"
#include "sweep/planted.hpp"
#include "sweep/record.hpp"
#include "sweep/report/pictures.hpp"
#include "sweep/run_scenes.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;

struct Pixel {
    float texels;
    ErrorKind kind;
};

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// A row of judged pixels, and one that nothing covers.
Film film_of(const std::vector<Pixel>& pixels) {
    Film film;
    film.frame = film.window = {0, 0, static_cast<int>(pixels.size()) + 1, 1};
    film.add("A", ChannelType::float32);
    for (const char* name : {"err.s", "err.uv", "err.search.s", "err.search.uv"})
        film.add(name, ChannelType::float32);
    for (const char* name :
         {"err.kind", "err.cell", "err.search.kind", "err.search.cell", "err.certified"})
        film.add(name, ChannelType::uint32);
    const auto set = [&](const char* name, std::size_t i, std::uint32_t bits) {
        film.find(name)->bits[i] = bits;
    };
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        set("A", i, std::bit_cast<std::uint32_t>(1.0f));
        for (const char* name : {"err.s", "err.uv", "err.search.s", "err.search.uv"})
            set(name, i, std::bit_cast<std::uint32_t>(pixels[i].texels));
        for (const char* name : {"err.kind", "err.search.kind"})
            set(name, i, static_cast<std::uint32_t>(pixels[i].kind));
        set("err.certified", i, 1);
    }
    return film;
}

const std::vector<Pixel> pixels{{0, ErrorKind::same},      {2, ErrorKind::late},
                                {0.25f, ErrorKind::early}, {7, ErrorKind::other_surface},
                                {3, ErrorKind::missed},    {not_a_number, ErrorKind::missed},
                                {4, ErrorKind::invented},  {not_a_number, ErrorKind::not_judged}};

TEST(RunError, CountsJudgedPixelsAlone) {
    const RunError error = run_error(film_of(pixels), 0.5);
    EXPECT_EQ(error.judged, 7u);
    EXPECT_EQ(error.certified, 7u);
    EXPECT_DOUBLE_EQ(error.wrong, 5.0 / 7);
    EXPECT_DOUBLE_EQ(error.nan, 1.0 / 7);
    EXPECT_DOUBLE_EQ(error.mean_texels, 16.25 / 6);
    EXPECT_DOUBLE_EQ(error.wrong_kinds[static_cast<std::size_t>(ErrorKind::missed)], 2.0 / 7);
    EXPECT_DOUBLE_EQ(error.wrong_kinds[static_cast<std::size_t>(ErrorKind::early)], 0);
    EXPECT_EQ(error.kinds.back(), ErrorKind::not_judged);
    EXPECT_DOUBLE_EQ(run_error(film_of(pixels), 5).wrong, 2.0 / 7);  // the tolerance is the plan's
    EXPECT_EQ(run_error(film_of(std::vector<Pixel>()), 0.5).judged, 0u);
}

/// The least value that so many per cent do not exceed.
testing::AssertionResult is_percentile(const RunError& error, double percent, double value) {
    double within = 0, below = 0, all = 0;
    for (const float v : error.texels) {
        if (!(v == v)) continue;
        all += 1;
        within += v <= value;
        below += v < value;
    }
    const double wanted = percent / 100 * all;
    if (within >= wanted && below < wanted) return testing::AssertionSuccess();
    return testing::AssertionFailure() << percent << ": " << value;
}

TEST(RunError, PercentilesHold) {
    std::vector<Pixel> many;
    for (int i = 0; i < 101; ++i) many.push_back({static_cast<float>(i * i), ErrorKind::late});
    RunError error = run_error(film_of(many), 0.5);
    error.texels.back() = not_a_number;  // of the pixel that nothing covers
    for (const double percent : {1.0, 10.0, 50.0, 90.0, 99.0, 100.0})
        EXPECT_TRUE(is_percentile(error, percent, error.texels_at(percent)));
    EXPECT_EQ(error.texels_at(99), spread_of(error.search, "uv").p99);
    EXPECT_FALSE(is_percentile(error, 50, error.mean_texels))
        << static_cast<int>(Planted::mean_for_percentile);
}

/// A sweep's figures of a run, and those of `quadrel errors` on its scene.
testing::AssertionResult say_the_same(const RunError& run, const ErrorSummary& errors) {
    const auto fail = [] { return testing::AssertionFailure(); };
    if (run.judged != errors.judged || run.certified != errors.certified) return fail() << "judged";
    for (const auto& [own, part] : {std::pair(&run.whole, 0), std::pair(&run.search, 1)}) {
        const ErrorPartSummary& other = errors.parts.at(static_cast<std::size_t>(part));
        if (own->name != other.name || own->kinds != other.kinds) return fail() << other.name;
        if (own->other_cell != other.other_cell) return fail() << other.name << " cells";
        for (const char* measure : {"s", "uv"}) {
            const ErrorSpread &a = spread_of(*own, measure), &b = spread_of(other, measure);
            if (a.values != b.values || a.p50 != b.p50 || a.p90 != b.p90 || a.p99 != b.p99 ||
                a.p999 != b.p999 || a.most != b.most)
                return fail() << b.channel;
        }
    }
    return testing::AssertionSuccess();
}

/// Blocks are judged by blocks, the others by bilinear patches.
TEST(RunError, IsWhatErrorsSaysOfTheScene) {
    const testing_films::TemporaryFolder folder;
    Plan plan = plan_of(folder, small_plan());
    plan.views = {{60.0}};
    plan.algorithms = {
        {"linear", {{"steps", 8}}, {}}, {"qdm", {}, {}}, {"linear", {{"steps", 16}}, {}}};
    RunScenes scenes(plan, folder / "maps");
    for (std::size_t i = 0; i < plan.algorithms.size(); ++i) {
        const sweep::Run run{0, 0, 0, i, "float", "auto", 1};
        const RunScene scene = scenes.scene_of(run);
        RunError error = scenes.judge(scene, run).error;
        const ErrorSummary errors = measure_errors(scene.scene);
        EXPECT_TRUE(say_the_same(error, errors)) << plan.algorithms[i].trace;
        EXPECT_EQ(error.judged, 256u);
        if (plan.algorithms[i].trace == "qdm") {
            EXPECT_LT(error.texels_at(99), 1e-3);  // its surface's first hits
        }
        // Planted: the run of another search, and the error of its frame for that of its search.
        Scene other = scene.scene;
        other.materials[0].trace = {"linear", {{"steps", 4}}, ""};
        EXPECT_FALSE(say_the_same(error, measure_errors(other)));
        error.search = errors.parts.at(2);
        error.search.name = "search";
        EXPECT_FALSE(say_the_same(error, errors));
    }
}

/// Runs of one view have one truth; that of another view, planted, is another.
TEST(RunError, WhatTheJudgeHasFoundServesOtherSearches) {
    const testing_films::TemporaryFolder folder;
    Plan plan = plan_of(folder, small_plan());
    plan.views = {{60.0}, {45.0}};
    plan.algorithms = {{"linear", {{"steps", 8}}, {}}, {"max-mip", {}, {}}};
    RunScenes scenes(plan, folder / "maps");
    const auto film = [&](std::size_t view, std::size_t algorithm, const std::string& number,
                          KnownTruths* truths) {
        RenderOptions options;
        options.number = number;
        options.channels = run_error_channels();
        options.truths = truths;
        return render(scenes.scene_of({0, 0, view, algorithm, number, "auto", 1}).scene, options);
    };
    for (const std::string number : {"float", "double"}) {
        KnownTruths truths(16, 16), others(16, 16);
        film(0, 0, number, &truths);
        film(1, 0, number, &others);
        const Film alone = film(0, 1, number, nullptr);
        EXPECT_EQ(film(0, 1, number, &truths), alone) << number;
        EXPECT_FALSE(film(0, 1, number, &others) == alone) << number;
    }
}

TEST(RunError, RecordsHaveNoNan) {
    Json record;
    add_error(record,
              run_error(film_of(std::vector<Pixel>{{not_a_number, ErrorKind::missed}}), 0.5));
    EXPECT_TRUE(record["texels_p99"].is_null());
    EXPECT_EQ(record["nan"], 1);
    EXPECT_EQ(record["missed"], 1);
    EXPECT_EQ(record.dump().find("NaN"), std::string::npos);
}

TEST(RunError, PicturesHaveOneScale) {
    const Picture picture = error_thumbnail(run_error(film_of(pixels), 0.5), 9, 1, 9);
    const auto colour = [&](int x) {
        return std::vector<int>(picture.rgb.begin() + 3 * x, picture.rgb.begin() + 3 * x + 3);
    };
    EXPECT_EQ(colour(0), (std::vector<int>{0, 0, 0}));
    EXPECT_GT(colour(1)[0], colour(1)[2]);  // late: warm
    EXPECT_LT(colour(2)[0], colour(2)[2]);  // early: cold
    EXPECT_GT(colour(3)[1], colour(3)[0]);  // another surface: green
    EXPECT_EQ(colour(4), colour(6));
    EXPECT_EQ(colour(5), (std::vector<int>{255, 255, 255}));
    EXPECT_EQ(colour(7), colour(8));
    EXPECT_EQ(data_uri(picture).substr(0, 32), "data:image/png;base64,iVBORw0KGg");
}

}  // namespace
}  // namespace quadrel::sweep_tests
