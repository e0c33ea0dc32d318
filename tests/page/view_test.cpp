// The viewer in a browser: its values are those of the image, what differs is shown, and damage is
// noticed.
#include "page/view.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "browser.hpp"
#include "page/planted.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel::page_tests {
namespace {

using planted::PageError;
using testing_browser::browse;
using testing_films::TemporaryFolder;

page::ViewSource source_of(const std::string& name, Film film) {
    canonicalize(film);
    ComparableImage image{name, std::move(film), {}, {{"note", "<b>&</b>"}}};
    for (const Plane& plane : image.film.planes)
        image.stored[plane.name] =
            plane.type == ChannelType::uint32 ? Storage::uint32 : Storage::float32;
    return {name, std::move(image)};
}

/// FNV-1a over words, as the page computes it.
std::uint32_t hash_of(const std::vector<std::uint32_t>& bits) {
    std::uint32_t hash = 2166136261u;
    for (const std::uint32_t word : bits) hash = (hash ^ word) * 16777619u;
    return hash;
}

class View : public testing::Test {
  protected:
    View() : film(testing_films::random_film(7)) {
        canonicalize(film);
        other = film;
        other.find("hit.P.X")->bits[other.index(5, 4)] ^= 1u;  // PageError::wrong_value
        other.find("hit.steps")->bits[other.index(6, 4)] += 3;
    }
    void SetUp() override {
        if (testing_browser::browser().empty()) GTEST_SKIP() << testing_browser::no_browser;
    }
    void write(const std::string& html) { testing_films::write_bytes(folder / "view.html", html); }
    void write_two() {
        const std::vector<page::ViewSource> sources = {source_of("a</script>.exr", film),
                                                       source_of("b.exr", other)};
        write(page::view_html(sources));
    }
    /// The page's elements after its script has run.
    std::string dom(const std::string& anchor) {
        EXPECT_TRUE(browse(folder, "view.html" + anchor,
                           "--disable-gpu --virtual-time-budget=20000 --dump-dom", "dom"))
            << testing_films::file_bytes(folder / "err");
        return testing_films::file_bytes(folder / "dom");
    }
    Film film, other;
    TemporaryFolder folder;
};

std::string value_mark(int source, const Film& film, const std::string& channel, int x, int y) {
    return fmt::format("data-of=\"{} {} {:#010x}\"", source, channel,
                       film.find(channel)->bits[film.index(x, y)]);
}

TEST_F(View, ShowsTheBitsOfBothImages) {
    write_two();
    const std::string text = dom("#channel=hit.P.X&view=difference&pixel=5,4");
    EXPECT_NE(text.find(fmt::format("data-ready=\"{}\"", film.planes.size())), std::string::npos);
    const auto has = [&](const std::string& mark) { return text.find(mark) != std::string::npos; };
    for (const Plane& plane : film.planes) {
        EXPECT_TRUE(has(value_mark(0, film, plane.name, 5, 4))) << plane.name;
        EXPECT_TRUE(has(value_mark(1, other, plane.name, 5, 4))) << plane.name;
        for (const Film* each : {&film, &other})
            EXPECT_TRUE(has(fmt::format("data-hash=\"{} {} {:#010x}\"", each == &other ? 1 : 0,
                                        plane.name, hash_of(each->find(plane.name)->bits))))
                << plane.name;
    }
    EXPECT_NE(value_mark(0, film, "hit.P.X", 5, 4).substr(10),
              value_mark(1, other, "hit.P.X", 5, 4).substr(10));
    EXPECT_TRUE(has("2 of 8 shared channels differ.")) << static_cast<int>(PageError::wrong_value);
    EXPECT_TRUE(has("1 ulp"));
}

TEST_F(View, NoticesDamage) {
    write_two();
    std::string html = testing_films::file_bytes(folder / "view.html");
    const std::size_t at = html.find("\"bits\":\"") + 8 + 200;
    html[at] = html[at] == 'A' ? 'B' : 'A';
    write(html);
    const std::string text = dom("");
    EXPECT_NE(text.find("data-ready=\"no\""), std::string::npos)
        << static_cast<int>(PageError::wrong_byte);
    EXPECT_NE(text.find("the data of channel R are damaged"), std::string::npos);
}

TEST_F(View, IsReadNarrowAndDark) {
    write_two();
    ASSERT_TRUE(browse(folder, "view.html",
                       "--disable-gpu --virtual-time-budget=20000 --window-size=400,1200 "
                       "--blink-settings=preferredColorScheme=0 --screenshot=shot.png",
                       "log"));
    const Image image = load_image(folder / "shot.png");
    EXPECT_EQ(image.width, 400);
    EXPECT_LT(image.values[0], 0.5);
    std::size_t other_than_ground = 0;
    for (std::size_t i = 0; i < image.values.size(); i += static_cast<std::size_t>(image.channels))
        other_than_ground += image.values[i] != image.values[0];
    EXPECT_GT(other_than_ground, image.values.size() / 50);
}

}  // namespace
}  // namespace quadrel::page_tests
