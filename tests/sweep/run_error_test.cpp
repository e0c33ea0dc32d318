// How errors are counted: films whose distances are known.
#include "sweep/run_error.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "quadrel/quad/value.hpp"
#include "sweep/planted.hpp"
#include "sweep/report/pictures.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;

struct Pixel {
    float s, u, v;
    Status status;
};

/// A row of pixels whose rays go along +u.
Film film_of(const std::vector<Pixel>& pixels, float Ku = 0.5f, float Kv = 0) {
    Film film;
    film.frame = film.window = {0, 0, static_cast<int>(pixels.size()), 1};
    for (const char* name : {"hit.s", "hit.U", "hit.V", "K.U", "K.V"})
        film.add(name, ChannelType::float32);
    film.add("hit.status", ChannelType::uint32);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float values[] = {pixels[i].s, pixels[i].u, pixels[i].v, Ku, Kv};
        for (std::size_t k = 0; k < 5; ++k)
            film.planes[k].bits[i] = std::bit_cast<std::uint32_t>(values[k]);
        film.planes[5].bits[i] = static_cast<std::uint32_t>(pixels[i].status);
    }
    return film;
}

const std::vector<Pixel> truth{{0.5f, 0.25f, 0, Status::hit}, {0.5f, 0.25f, 0, Status::hit},
                               {0.5f, 0.25f, 0, Status::hit}, {1, 0.5f, 0, Status::floor},
                               {0.5f, 0.25f, 0, Status::hit}, {0.5f, 0.25f, 0, Status::hit},
                               {0, 0, 0, Status::none},       {0.5f, 0.25f, 0, Status::hit}};
const std::vector<Pixel> found{{0.5f, 0.25f, 0, Status::hit},   {0.75f, 0.375f, 0, Status::hit},
                               {0.25f, 0.125f, 0, Status::hit}, {0.5f, 0.25f, 0, Status::hit},
                               {1, 0.5f, 0, Status::floor},     {0, 0, 0, Status::nan},
                               {0, 0, 0, Status::none},         {0.5f, 0.25f, 0.125f, Status::cap}};

/// A sixteenth of the map's width is a texel, an eighth of its height.
RunError error_of(const Film& run) { return run_error(run, film_of(truth), 16, 8, 0.5); }

TEST(RunError, EachRayEndsInItsOwnWay) {
    const RunError error = error_of(film_of(found));
    const std::vector<RayEnd> expected{RayEnd::same,        RayEnd::late,        RayEnd::early,
                                       RayEnd::hit_of_miss, RayEnd::miss_of_hit, RayEnd::nan,
                                       RayEnd::none,        RayEnd::late};
    EXPECT_EQ(error.ends, expected);
    EXPECT_EQ(error.rays, 7u);
    EXPECT_DOUBLE_EQ(error.late, 2.0 / 7);
    EXPECT_DOUBLE_EQ(error.wrong(), 6.0 / 7);
    // A search that runs the other way has its sides swapped.
    EXPECT_NE(run_error(film_of(found), film_of(truth, -0.5f), 16, 8, 0.5).ends, expected)
        << static_cast<int>(Planted::swapped_sides);
}

TEST(RunError, DistancesAreInTexelsOfTheirAxis) {
    const RunError error = error_of(film_of(found));
    EXPECT_FLOAT_EQ(error.map[1], 2);
    EXPECT_FLOAT_EQ(error.map[2], -2);
    EXPECT_FLOAT_EQ(error.map[7], 1);
    EXPECT_TRUE(std::isnan(error.map[5]) && std::isnan(error.map[6]));
    EXPECT_NE(run_error(film_of(found), film_of(truth), 16, 16, 0.5).map[7], error.map[7])
        << static_cast<int>(Planted::texels_of_one_axis);
}

TEST(RunError, TheToleranceIsThePlans) {
    const RunError wide = run_error(film_of(found), film_of(truth), 16, 8, 3);
    EXPECT_EQ(wide.ends[1], RayEnd::same);
    EXPECT_EQ(wide.ends[4], RayEnd::miss_of_hit);
    EXPECT_EQ(error_of(film_of(truth)).wrong(), 0);
}

/// The least value that so many per cent do not exceed.
testing::AssertionResult is_percentile(const std::vector<float>& sorted, double percent,
                                       double value) {
    double within = 0, below = 0;
    for (const float v : sorted) {
        within += v <= value;
        below += v < value;
    }
    const double wanted = percent / 100 * static_cast<double>(sorted.size());
    if (within >= wanted && below < wanted) return testing::AssertionSuccess();
    return testing::AssertionFailure() << percent << ": " << value;
}

TEST(RunError, PercentilesHold) {
    Percentiles p;
    for (int i = 0; i < 101; ++i) p.sorted.push_back(static_cast<float>(i * i));
    for (const double percent : {1.0, 10.0, 50.0, 90.0, 99.0, 100.0})
        EXPECT_TRUE(is_percentile(p.sorted, percent, p.at(percent)));
    EXPECT_FALSE(is_percentile(p.sorted, 50, 3383.5))
        << static_cast<int>(Planted::mean_for_percentile);
    EXPECT_EQ(Percentiles().at(99), 0);
}

TEST(RunError, PicturesHaveOneScale) {
    const RunError error = error_of(film_of(found));
    const Picture picture = error_thumbnail(error, 8, 1, 8);
    const auto colour = [&](int x) {
        return std::vector<int>(picture.rgb.begin() + 3 * x, picture.rgb.begin() + 3 * x + 3);
    };
    EXPECT_EQ(colour(0), (std::vector<int>{0, 0, 0}));
    EXPECT_GT(colour(1)[0], colour(1)[2]);  // late: warm
    EXPECT_LT(colour(2)[0], colour(2)[2]);  // early: cold
    EXPECT_EQ(colour(3), colour(4));
    EXPECT_EQ(colour(5), (std::vector<int>{255, 255, 255}));
    EXPECT_EQ(data_uri(picture).substr(0, 32), "data:image/png;base64,iVBORw0KGg");
}

}  // namespace
}  // namespace quadrel::sweep_tests
