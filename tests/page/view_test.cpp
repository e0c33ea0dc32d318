// The viewer in a browser: its values are those of the image, what differs is shown, and damage is
// noticed.
#include "page/view.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "browser.hpp"
#include "page/planted.hpp"
#include "quadrel/film/legal.hpp"
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
        add_ranges();
    }
    /// A channel that `film` holds ranges of, with values of each class.
    void add_ranges() {
        Plane value{"Q", ChannelType::float32, {}};
        for (std::size_t i = 0; i < film.window.area(); ++i)
            value.bits.push_back(testing_films::bits(static_cast<float>(i)));
        const auto add = [&](const char* name) -> Plane& {
            film.planes.push_back(value);
            film.planes.back().name = name;
            return film.planes.back();
        };
        other.planes.push_back(value);
        add("Q");
        add("gpu.lo.Q").bits[8] = testing_films::bits(-INFINITY);
        add("gpu.hi.Q").bits[9] = testing_films::bits(NAN);
        Plane& paths = add("gpu.paths.Q");
        paths.type = ChannelType::uint32;
        std::ranges::fill(paths.bits, 1u);
        paths.bits[5] = 0;
        paths.bits[6] = paths.bits[7] = 2;
        // At pixel 13 a gap holds the value.
        const std::pair<const char*, float> ends[] = {
            {"gpu.lo.Q", -1.f}, {"gpu.hi.Q", 20.f}, {"gpu.gap.lo.Q", 12.f}, {"gpu.gap.hi.Q", 15.f}};
        add("gpu.gap.lo.Q");
        add("gpu.gap.hi.Q");
        for (const auto& [name, end] : ends)
            std::ranges::find(film.planes, name, &Plane::name)->bits[13] = testing_films::bits(end);
        for (const int i : {10, 11, 12})
            other.planes.back().bits[static_cast<std::size_t>(i)] =
                testing_films::bits(i == 10 ? NAN : -1);
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

/// Whether the page has every value of a pixel of one of its images, and all bits by their hash.
testing::AssertionResult shows(const std::string& dom, int source, const Film& film, int x, int y) {
    for (const Plane& plane : film.planes) {
        const std::string hash =
            fmt::format("data-hash=\"{} {} {:#010x}\"", source, plane.name, hash_of(plane.bits));
        if (dom.find(value_mark(source, film, plane.name, x, y)) == std::string::npos)
            return testing::AssertionFailure() << plane.name << " of the pixel";
        if (dom.find(hash) == std::string::npos)
            return testing::AssertionFailure() << plane.name << " as a whole";
    }
    return testing::AssertionSuccess();
}

/// Verdicts are those of compare --legal.
testing::AssertionResult counts_verdicts(const std::string& dom, const Film& film,
                                         const Film& other) {
    const LegalReport report = judge(take_apart(film, ""), other, {});
    for (const LegalVerdict verdict : {LegalVerdict::pass, LegalVerdict::ambiguous,
                                       LegalVerdict::unconstrained, LegalVerdict::fail}) {
        const auto count = report.channels.at(0).count(verdict);
        const std::string line = fmt::format("{}: {}</span>", legal_verdict_name(verdict), count);
        if (count == 0 || dom.find(line) == std::string::npos)
            return testing::AssertionFailure() << line;
    }
    return testing::AssertionSuccess();
}

TEST_F(View, ShowsTheBitsOfBothImagesAndVerdicts) {
    write_two();
    const std::string text = dom("#channel=Q&view=classes&pixel=5,4");
    EXPECT_NE(text.find(fmt::format("data-ready=\"{}\"", film.planes.size())), std::string::npos);
    EXPECT_TRUE(shows(text, 0, film, 5, 4));
    EXPECT_TRUE(shows(text, 1, other, 5, 4));
    EXPECT_FALSE(shows(text, 1, film, 5, 4)) << static_cast<int>(PageError::wrong_value);
    EXPECT_NE(text.find("3 of 9 shared channels differ."), std::string::npos);
    EXPECT_NE(text.find("1 ulp"), std::string::npos);
    EXPECT_TRUE(counts_verdicts(text, film, other));
    other.find("Q")->bits[20] = testing_films::bits(-1);
    EXPECT_FALSE(counts_verdicts(text, film, other)) << static_cast<int>(PageError::wrong_verdict);
}

TEST_F(View, OpensOnWhatBothHave) {
    std::erase_if(other.planes, [](const Plane& plane) { return plane.name != "hit.P.X"; });
    write_two();
    const char* const lacks = "id=\"worst-lead\">One of the images lacks this channel";
    const std::string text = dom("");
    EXPECT_EQ(text.find(lacks), std::string::npos);
    EXPECT_NE(text.find(", 1 channel. 1 of 1 shared channel differs."), std::string::npos);
    // A channel that one of them alone has is shown when asked for.
    EXPECT_NE(dom("#channel=R").find(lacks), std::string::npos);
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
