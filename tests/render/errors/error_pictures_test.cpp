// Pictures of errors: one scale for all films.
#include <set>

#include "quadrel/error.hpp"
#include "quadrel/error_pictures.hpp"
#include "render/errors/judged_scenes.hpp"

namespace quadrel::render_tests {
namespace {

using Rgb = std::array<int, 3>;

Rgb colour(const Picture& picture, int x) {
    const auto at = static_cast<std::size_t>(3 * x);
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

/// A row of pixels with these values of a channel.
Film row(const std::string& channel, const std::vector<float>& values) {
    const Window window{0, 0, static_cast<int>(values.size()), 1};
    Film film{window, window, {}};
    film.add("A", ChannelType::float32, std::bit_cast<std::uint32_t>(1.0f));
    Plane& plane = film.add(channel, ChannelType::float32);
    for (std::size_t i = 0; i < values.size(); ++i)
        plane.bits[i] = std::bit_cast<std::uint32_t>(values[i]);
    return film;
}

TEST(ErrorPictures, HaveOneScale) {
    const float nothing = 0, small = 1.0f / 300, large = 64, none = std::nanf("");
    const Picture one = error_picture(row("err.uv", {nothing, small, 1, large, none}), "err.uv");
    const Picture other = error_picture(row("err.uv", {1, 1e6f, -1}), "err.uv");
    EXPECT_EQ(colour(one, 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(colour(one, 1), (Rgb{0, 0, 0}));
    EXPECT_EQ(colour(one, 2), colour(other, 0));
    EXPECT_EQ(colour(one, 2), colour(other, 2));
    EXPECT_EQ(colour(one, 3), (Rgb{255, 255, 255}));
    EXPECT_EQ(colour(one, 3), colour(other, 1));
    EXPECT_EQ(colour(one, 4), (Rgb{120, 120, 120}));
    EXPECT_NE(colour(one, 2), colour(one, 3));
    EXPECT_THROW(error_picture(row("err.uv", {1}), "err.normal"), UsageError);
    EXPECT_THROW(error_picture(row("hit.U", {1}), "hit.U"), UsageError);
}

TEST(ErrorPictures, ShowTheLargestOfThreeColours) {
    Film film = row("err.color.R", {0.5f, 0.01f});
    film.add("err.color.G", ChannelType::float32).bits = {0, std::bit_cast<std::uint32_t>(-0.5f)};
    const Picture picture = error_picture(film, "err.color");
    EXPECT_EQ(colour(picture, 0), colour(picture, 1));
    EXPECT_NE(colour(picture, 0), (Rgb{0, 0, 0}));
}

TEST(ErrorPictures, TellKindsApart) {
    Film film = row("err.uv", std::vector<float>(error_kinds + 1, 0.0f));
    Plane& kinds = film.add("err.kind", ChannelType::uint32);
    for (std::size_t k = 0; k < error_kinds; ++k) kinds.bits[k] = static_cast<std::uint32_t>(k);
    film.find("A")->bits.back() = 0;
    const Picture picture = error_picture(film, "err.kind");
    std::set<Rgb> colours;
    for (int x = 0; x < picture.width; ++x) colours.insert(colour(picture, x));
    EXPECT_EQ(colours.size(), error_kinds + 1);
    EXPECT_EQ(colour(picture, picture.width - 1), (Rgb{0, 0, 0}));
    EXPECT_GT(error_sheet(film).width, picture.width);
}

}  // namespace
}  // namespace quadrel::render_tests
