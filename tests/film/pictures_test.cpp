// Heat maps by kind, and vectors in colour.
#include <gtest/gtest.h>

#include <functional>

#include "film/films.hpp"
#include "film/planted.hpp"
#include "quadrel/film/heatmap.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;
using testing_films::bits;

Film film_of(const std::vector<std::string>& floats, const std::vector<std::string>& integers) {
    Film film{{0, 0, 4, 2}, {0, 0, 4, 2}, {}};
    for (const std::string& name : floats) film.add(name, ChannelType::float32);
    for (const std::string& name : integers) film.add(name, ChannelType::uint32);
    return film;
}

using Rgb = std::vector<int>;

Rgb pixel(const Picture& picture, std::size_t i) {
    return {picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]};
}

TEST(Heatmap, ChannelsHaveKinds) {
    for (const char* name : {"R", "A", "light.diffuse.G", "shadow.1.visibility", "occlusion"})
        EXPECT_EQ(heat_kind(name, ChannelType::float32), HeatKind::colour) << name;
    for (const char* name : {"P.X", "uv.U", "hit.s", "Z", "beauty"})
        EXPECT_EQ(heat_kind(name, ChannelType::float32), HeatKind::value) << name;
    for (const char* name : {"hit.steps", "hit.fetches", "shadow.0.steps"})
        for (const ChannelType type : {ChannelType::uint32, ChannelType::float32})
            EXPECT_EQ(heat_kind(name, type), HeatKind::count) << name;
    for (const char* name : {"hit.status", "hit.flags", "id.object", "mask"})
        EXPECT_EQ(heat_kind(name, ChannelType::uint32), HeatKind::code) << name;
}

using Panels = std::function<std::vector<HeatPanel>(const Film&, const Film&)>;

/// An error of colour is as hot with counts and flags that are far off as without.
AssertionResult counts_do_not_drown_colours(const Panels& panels) {
    Film a = film_of({"R", "uv.U"}, {"hit.steps", "hit.flags"}), b = a;
    b.planes[0].bits[0] = bits(1e-4f);
    const Rgb alone = pixel(panels(a, b).at(0).picture, 0);
    b.planes[2].bits[0] = 100;
    b.planes[3].bits[0] = 4;
    if (pixel(panels(a, b).at(0).picture, 0) != alone) return AssertionFailure() << "drowned";
    return AssertionSuccess();
}

TEST(Heatmap, CountsDoNotDrownColours) {
    EXPECT_TRUE(counts_do_not_drown_colours(heat_panels));
    EXPECT_FALSE(counts_do_not_drown_colours([](const Film& a, const Film& b) {  // heat_one_scale
        std::vector<HeatPanel> panels = heat_panels(a, b);
        for (const HeatPanel& panel : panels)
            for (std::size_t i = 0; i < panel.picture.rgb.size(); ++i)
                panels[0].picture.rgb[i] = std::max(panels[0].picture.rgb[i], panel.picture.rgb[i]);
        return panels;
    }));
}

TEST(Heatmap, EachKindHasItsScale) {
    Film a = film_of({"R", "P.X"}, {"hit.steps", "id.object"}), b = a;
    a.planes[1].bits[0] = bits(1000);
    b.planes[1].bits[0] = bits(1001);
    b.planes[0].bits[0] = bits(1e-3f);
    for (std::size_t i = 0; i < 3; ++i) b.planes[2].bits[i] = 1u << (4 * i);
    b.planes[3].bits = {1, 2, 3, 4, 5, 6, 7, 0};
    const std::vector<HeatPanel> panels = heat_panels(a, b);
    ASSERT_EQ(panels.size(), 4u);
    EXPECT_EQ(panels[2].channels, std::vector<std::string>{"hit.steps"});
    EXPECT_EQ(pixel(panels[0].picture, 0), pixel(panels[1].picture, 0)) << "1 of 1000, as 0.001";
    const auto heat = [&](std::size_t i) {
        const Rgb rgb = pixel(panels[2].picture, i);
        return rgb[0] + rgb[1] + rgb[2];
    };
    EXPECT_LT(heat(0), heat(1));
    EXPECT_LT(heat(1), heat(2));
    for (std::size_t i = 1; i < 7; ++i)
        EXPECT_EQ(pixel(panels[3].picture, i), pixel(panels[3].picture, 0)) << "no code is worse";
    EXPECT_EQ(pixel(panels[3].picture, 7), (Rgb{0, 0, 0}));
}

TEST(Heatmap, LegendsStandBelow) {
    const Film a = film_of({"R", "P.X"}, {"hit.steps", "id.object"});
    const Picture four = heatmap(a, a), one = heatmap(film_of({"R"}, {}), film_of({"R"}, {}));
    EXPECT_GT(one.height, a.window.height() + 20);
    EXPECT_GE(four.width, 4 * (one.width - 8));
    EXPECT_GT(std::count(one.rgb.begin(), one.rgb.end(), 224), 100) << "letters";
}

using Preview = std::function<Picture(const Film&)>;

/// Normals along the axes have the colours of normal maps; what nothing covers is black.
AssertionResult shows_normals(const Preview& preview_) {
    Film film = film_of({"N.X", "N.Y", "N.Z", "Z"}, {});
    film.planes[0].bits[0] = film.planes[1].bits[1] = film.planes[2].bits[2] = bits(1);
    film.planes[0].bits[3] = bits(-1);
    const Picture picture = preview_(film);
    const Rgb expected[] = {
        {255, 128, 128}, {128, 255, 128}, {128, 128, 255}, {0, 128, 128}, {0, 0, 0}};
    for (std::size_t i = 0; i < 5; ++i)
        if (pixel(picture, i) != expected[i]) return AssertionFailure() << "pixel " << i;
    return AssertionSuccess();
}

TEST(Preview, VectorsAreShownInColour) {
    EXPECT_TRUE(shows_normals(preview));
    EXPECT_FALSE(shows_normals([](const Film& film) {  // vectors_in_gray
        Film first{film.frame, film.window, {film.planes[0]}};
        return preview(first);
    }));
}

TEST(Preview, TextureCoordinatesAndPoints) {
    Film film = film_of({"uv.U", "uv.V"}, {});
    film.planes[0].bits[0] = bits(1.25f);
    film.planes[1].bits[0] = bits(-0.25f);
    EXPECT_EQ(pixel(preview(film), 0), (Rgb{64, 191, 0})) << "their fraction";
    Film points = film_of({"P.X", "P.Y", "P.Z"}, {});
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            points.planes[c].bits[i] = bits(static_cast<float>(i * (c + 1)) - 7.0f);
    EXPECT_EQ(pixel(preview(points), 0), (Rgb{0, 0, 0}));
    EXPECT_EQ(pixel(preview(points), 1), (Rgb{128, 128, 128}));
    EXPECT_EQ(pixel(preview(points), 2), (Rgb{255, 255, 255}));
    EXPECT_EQ(preview_channels(points), (std::vector<std::string>{"P.X", "P.Y", "P.Z"}));
    points.planes[1].bits[1] = canonical_nan;
    EXPECT_EQ(pixel(preview(points), 1), (Rgb{255, 0, 255}));
}

TEST(Preview, GroupsOfTheFirstChannel) {
    const auto shown = [](const std::vector<std::string>& names) {
        return preview_channels(film_of(names, {}));
    };
    EXPECT_EQ(shown({"Z", "B", "G", "R"}), (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(shown({"light.diffuse.B", "light.diffuse.G", "light.diffuse.R"}),
              (std::vector<std::string>{"light.diffuse.R", "light.diffuse.G", "light.diffuse.B"}));
    EXPECT_EQ(shown({"hit.P.Z", "hit.P.Y", "hit.P.X", "hit.U"}),
              (std::vector<std::string>{"hit.P.X", "hit.P.Y", "hit.P.Z"}));
    EXPECT_EQ(shown({"hit.U", "hit.V", "hit.s"}), (std::vector<std::string>{"hit.U", "hit.V"}));
    EXPECT_EQ(shown({"bary.0", "bary.1", "bary.2"}).size(), 3u);
    EXPECT_EQ(shown({"N.X", "N.Y"}), std::vector<std::string>{"N.X"});
    EXPECT_EQ(shown({"Z", "N.X", "N.Y", "N.Z"}), std::vector<std::string>{"Z"});
}

}  // namespace
}  // namespace quadrel
