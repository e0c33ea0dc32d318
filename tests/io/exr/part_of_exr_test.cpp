// Reading a part of an EXR, or all of it band by band, gives what reading all of it gives.
#include <gtest/gtest.h>

#include <functional>

#include "film/films.hpp"
#include "film/plane_summary.hpp"
#include "film/planted.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::TemporaryFolder;

/// More than two bands of 256 rows, the last one of three.
const Window tall_window{-3, 5, 14, 5 + 515};

Film three_bands() {
    return testing_films::sorted_by_name(
        testing_films::random_film(3, {-10, 0, 40, 600}, tall_window));
}

/// Joins bands, the first row of each `late` rows further down.
Film joined(const std::filesystem::path& file, int late) {
    Film all;
    const ExrFile read = read_exr_in_bands(file, {}, [&](const Film& band) {
        if (all.planes.empty())
            for (const Plane& plane : band.planes)
                all.planes.push_back({plane.name, plane.type, {}});
        for (std::size_t p = 0; p < band.planes.size(); ++p) {
            auto bits = band.planes[p].bits;
            std::rotate(bits.begin(), bits.end() - late * band.window.width(), bits.end());
            all.planes[p].bits.insert(all.planes[p].bits.end(), bits.begin(), bits.end());
        }
    });
    all.frame = read.film.frame;
    all.window = read.film.window;
    return all;
}

AssertionResult joins(const std::function<Film(const std::filesystem::path&)>& join) {
    const TemporaryFolder folder;
    Film film = three_bands();
    for (const auto& [name, compression] : exr_compressions) {
        write_exr(folder / "a.exr", film, {}, {compression});
        if (join(folder / "a.exr") != read_exr(folder / "a.exr").film)
            return AssertionFailure() << name << ": another film";
    }
    return AssertionSuccess();
}

TEST(PartOfExr, BandsAreTheWhole) {
    EXPECT_TRUE(joins([](const auto& file) { return joined(file, 0); }));
    EXPECT_FALSE(joins([](const auto& file) { return joined(file, 1); }))
        << static_cast<int>(planted::FilmError::rows_off_by_band);
}

TEST(PartOfExr, WindowsAreCrops) {
    const TemporaryFolder folder;
    for (const auto& [name, compression] : exr_compressions) {
        write_exr(folder / "a.exr", three_bands(), {}, {compression});
        for (const Window& window : {Window{-3, 5, 14, 6}, Window{0, 100, 3, 117}, tall_window}) {
            Film crop_of_all = read_exr(folder / "a.exr").film;
            crop(crop_of_all, window);
            EXPECT_TRUE(read_exr(folder / "a.exr", {}, window).film == crop_of_all) << name;
        }
        EXPECT_EQ(read_exr(folder / "a.exr", {}, Window{0, 0, 3, 8}).film.window, tall_window)
            << "not all of it is there";
    }
}

TEST(PlaneSummaries, AddUpOverBands) {
    constexpr std::uint32_t inf = 0x7f800000u, nan = 0x7fc00000u, minus = 0x80000000u;
    PlaneSummary summary;
    summary.add({"a", ChannelType::float32, {nan, inf, minus | inf, nan | minus}});
    EXPECT_GT(summary.low, summary.high);
    summary.add({"a", ChannelType::float32, {0x3f800000u, minus | 0x40000000u, nan}});
    EXPECT_EQ(summary.low, -2.0f);
    EXPECT_EQ(summary.high, 1.0f);
    EXPECT_EQ(summary.nan, 3u);
    EXPECT_EQ(summary.infinite, 2u);
    PlaneSummary integers;
    integers.add({"i", ChannelType::uint32, {7, 0xffffffffu}});
    integers.add({"i", ChannelType::uint32, {3}});
    EXPECT_EQ(integers.least, 3u);
    EXPECT_EQ(integers.most, 0xffffffffu);
}

}  // namespace
}  // namespace quadrel
