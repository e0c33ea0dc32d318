// The judge's page in a browser: a scene drawn by the browser's own GPU is found legal, and one
// whose shader was changed is not.
#include "export/scene/judge_page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "effort.hpp"
#include "export/scene/content.hpp"
#include "export/scene/judged.hpp"
#include "page/range_codes.hpp"
#include "quadrel/error.hpp"
#include "random.hpp"

namespace quadrel::export_tests {
namespace {

constexpr const char* no_gpu =
    "--disable-gpu --disable-software-rasterizer --disable-3d-apis --virtual-time-budget=20000 "
    "--dump-dom";

constexpr const char* limits = "gl,snapping=0.0625";

/// Hashes of what was drawn, by channel.
std::string drawn_hashes(const std::string& dom) {
    std::string all;
    const std::string mark = "data-hash=\"1 ";
    for (std::size_t at = dom.find(mark); at != std::string::npos; at = dom.find(mark, at + 1))
        all += dom.substr(at, dom.find('"', at + mark.size()) - at) + "\n";
    return all;
}

TEST_F(JudgePageInABrowser, FindsWhatItsGpuDrawsLegal) {
    const std::string page = judge_page(small_scene(), {{}, limits});
    const Judged judged(page, "#view=first&channel=hit.U&pixel=5,4");
    expect_legal(judged);
    // Values of both sides at the pixel.
    EXPECT_NE(judged.dom().find("data-of=\"0 hit.U 0x"), std::string::npos);
    EXPECT_NE(judged.dom().find("data-of=\"1 hit.U 0x"), std::string::npos);
    EXPECT_NE(judged.dom().find(">No channel leaves its range here."), std::string::npos);
    EXPECT_EQ(judged.dom().find("This GPU knows 4 bits"), std::string::npos);
    // Bits that come back as bytes are the same.
    const Judged packed(page, "#targets=packed");
    ASSERT_EQ(packed.error(), "");
    EXPECT_NE(drawn_hashes(judged.dom()), "");
    EXPECT_EQ(drawn_hashes(judged.dom()), drawn_hashes(packed.dom()));
    EXPECT_NE(packed.dom().find("<li>As asked for, bits are drawn as bytes"), std::string::npos);
    const Judged emulated(page, "#samplers=emulated");
    expect_legal(emulated);
    EXPECT_NE(emulated.dom().find("height_map: sampled by texelFetch"), std::string::npos);
}

TEST_F(JudgePageInABrowser, ShowsPlantedErrors) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    struct Planted {
        const char *from, *to, *first;
    };
    const Planted errors[] = {
        {"dUVdx = dFdx(uv);", "dUVdx = dFdy(uv);", "dUVdx.U"},  // a swapped derivative
        {"float(i) / float(steps);", "float(i) / float(steps + 1);", "hit.V"},  // a step too many
        {"[\"repeat\",\"repeat\"]", "[\"clamp-to-edge\",\"repeat\"]", "hit."},  // wrong wrap
        {"max(cosine, 0.0)", "cosine", "R"},                                    // a missing clamp
        {"(light0_position - hit_P)", "(eye - hit_P)", "R"},  // light from the wrong point
        {"    quad_differentiate(P, uv,",                     // a hole
         "    if (4.0 > gl_FragCoord.x) discard; quad_differentiate(P, uv,", "A"}};
    const std::string page = judge_page(small_scene(), {{}, limits});
    for (const auto& [from, to, first] : errors) {
        const Judged judged(with_planted(page, from, to), "");
        EXPECT_GT(judged.failing(), 0) << to << judged.error();
        EXPECT_TRUE(judged.first_to_leave().starts_with(first))
            << to << ": " << judged.first_to_leave();
    }
}

TEST_F(JudgePageInABrowser, IsAViewerWhereNothingCanBeDrawn) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    const std::string page = judge_page(small_scene(), {{}, ""});
    const Judged judged(with_planted(page, "hit_uv = ", "hit_uv = missing + "), "");
    EXPECT_NE(judged.error().find("bricks.frag does not compile"), std::string::npos)
        << judged.error();
    EXPECT_NE(judged.error().find("missing + "), std::string::npos) << judged.error();
    EXPECT_NE(judged.dom().find("data-ready=\"19\""), std::string::npos);
    const Judged without(page, "", no_gpu);
    EXPECT_EQ(without.error(), "this browser has no WebGL 2");
    EXPECT_NE(without.dom().find("data-ready=\"19\""), std::string::npos);
}

TEST(JudgePage, OfTheSameSceneIsTheSame) {
    JudgePage options;
    options.limits = limits;
    options.scene.channels = {"uv", "A"};
    const std::string page = judge_page(small_scene(), options);
    EXPECT_EQ(judge_page(small_scene(), options), page);
    options.every = 3;
    EXPECT_NE(judge_page(small_scene(), options), page);
}

/// Light or shadow: at some pixels nothing between.
void add_ragged_gaps(Film& film) {
    // At the same pixels in all colours.
    for (const std::string name : {"R", "G", "B"}) {
        const Plane* const values = film.find(name);
        if (values == nullptr) continue;
        test::Random random(7);
        Plane &low = *film.find("gpu.gap.lo." + name), &high = *film.find("gpu.gap.hi." + name);
        for (std::size_t i = 0; i < values->bits.size(); ++i) {
            if (!random.chance(0.15)) continue;
            const double value = values->as_float(i), apart = random.uniform(0.01, 0.3);
            low.bits[i] = testing_films::bits(static_cast<float>(value * (1 + apart / 8)));
            high.bits[i] = testing_films::bits(static_cast<float>(value * (1 + apart)));
        }
    }
}
/// Ranges in the place of real ones, of which such a picture takes an hour, with the entropy that
/// 2048 pixels of bricks-45 in 256x256 under gl have: ends of normals and colours some 4.6 bits,
/// each pixel by itself, those of what is smooth 2, so that all of them take 1.04 MB.
void add_ragged_ranges(Film& film) {
    test::Random random(5);
    std::vector<std::string> names;
    for (const Plane& plane : film.planes)
        if (plane.type == ChannelType::float32 && plane.name != "A") names.push_back(plane.name);
    for (const std::string& name : names) {
        const bool ragged = name.size() == 1 || name.starts_with("N.");
        for (const auto& [end, sign] : {std::pair{"gpu.lo.", -1.0}, {"gpu.hi.", 1.0}}) {
            const Plane values = *film.find(name);
            Plane& plane = film.add(end + name, ChannelType::float32);
            for (std::size_t i = 0; i < plane.bits.size(); ++i) {
                const double value = values.as_float(i);
                const double octave = ragged ? random.uniform(8, 10.5) : random.uniform(8, 8.4);
                const double apart = std::exp2(octave) * std::abs(value) * 0x1p-24;
                plane.bits[i] = testing_films::bits(static_cast<float>(value + sign * apart));
            }
        }
        film.add("gpu.paths." + name, ChannelType::uint32, 1);
        for (const char* end : {"gpu.gap.lo.", "gpu.gap.hi."}) {
            const std::vector<std::uint32_t> none = film.find(name)->bits;
            film.add(end + name, ChannelType::float32).bits = none;
        }
    }
    add_ragged_gaps(film);
}

/// Of which ranges are made up.
JudgePage page_of_normals() {
    JudgePage options;
    options.scene.language = "glsl-es";
    options.scene.channels = {"N", "A"};
    return options;
}

/// Ranges about N.Z in which it is, if it is in no gap: there is one at a pixel.
void add_gap(Film& film, std::size_t pixel) {
    const Plane values = *film.find("N.Z");
    const std::pair<const char*, float> ends[] = {
        {"gpu.lo.", 0.5f}, {"gpu.hi.", 2.0f}, {"gpu.gap.lo.", 0.8f}, {"gpu.gap.hi.", 1.25f}};
    for (const auto& [end, factor] : ends) {
        const std::string name = std::string(end) + "N.Z";
        Plane* plane = film.find(name);
        if (plane == nullptr) plane = &film.add(name, ChannelType::float32);
        const bool is_gap = name.starts_with("gpu.gap");
        for (std::size_t i = 0; i < values.bits.size(); ++i) {
            const bool apart = !is_gap || i == pixel;
            plane->bits[i] = testing_films::bits(values.as_float(i) * (apart ? factor : 1));
        }
    }
}

TEST_F(JudgePageInABrowser, FindsWhatLiesInAGap) {
    const JudgePage options = page_of_normals();
    const Scene scene = small_scene();
    const ExportContent content = export_content(scene, options.scene);
    Film film = content.expected;
    film.add("gpu.paths.N.Z", ChannelType::uint32, 1);
    const std::size_t pixel = film.index(5, 4);
    ASSERT_GT(film.find("N.Z")->as_float(pixel), 0);
    add_gap(film, pixel);
    const Judged judged(judge_page_of(content, film, options, ""), "");
    EXPECT_EQ(judged.failing(), 1) << judged.error() << judged.verdict().dump(1);
    EXPECT_EQ(judged.first_to_leave(), "N.Z");
    ASSERT_EQ(judged.verdict()["rows"].size(), 1u);
    EXPECT_GT(judged.verdict()["rows"][0]["farthest"].get<double>(), 0);
}

/// Of pixels without ranges nothing is said but that: neither by the line on top, the table and the
/// pictures' legend, nor where one looks at a pixel.
TEST_F(JudgePageInABrowser, SaysWhatIsNotJudged) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    const JudgePage options = page_of_normals();
    const Scene scene = small_scene();
    const ExportContent content = export_content(scene, options.scene);
    Film film = content.expected;
    const std::size_t pixels = film.window.area();
    // What is drawn is elsewhere in its range than the reference.
    for (std::uint32_t& value : film.find("N.Z")->bits)
        value = testing_films::bits(std::bit_cast<float>(value) * 1.001f);
    const Plane values = *film.find("N.Z");
    for (const auto& [end, factor] : {std::pair{"gpu.lo.", 0.99f}, {"gpu.hi.", 1.01f}}) {
        Plane& plane = film.add(std::string(end) + "N.Z", ChannelType::float32);
        for (std::size_t i = 0; i < pixels; ++i)
            plane.bits[i] = testing_films::bits(values.as_float(i) * factor);
    }
    Plane& paths = film.add("gpu.paths.N.Z", ChannelType::uint32, 1);
    std::fill_n(paths.bits.begin() + static_cast<std::ptrdiff_t>(pixels / 2), pixels / 2,
                0xffffffffu);
    const auto judge = [&](const std::string& anchor) {
        return Judged(judge_page_of(content, film, options, ""), anchor);
    };
    const auto says = [](const Judged& judged, const std::string& text) {
        return judged.dom().find(text) != std::string::npos;
    };
    const std::string half = std::to_string(pixels / 2);
    const Judged judged = judge("#view=first&channel=N.Z&pixel=1,1");
    EXPECT_EQ(judged.failing(), 0) << judged.error() << judged.verdict().dump(1);
    EXPECT_EQ(judged.verdict()["rows"][0]["counts"][4], pixels / 2);
    EXPECT_TRUE(says(judged, "None of " + half + " judged pixels leaves its legal range; " + half +
                                 " are not judged."));
    EXPECT_TRUE(says(judged, "; the " + half + " pixels that are judged are in range, " + half +
                                 " are not judged"));
    // As an element's text: the script has the words, too.
    EXPECT_TRUE(says(judged, ">No channel leaves its range here."));
    EXPECT_TRUE(says(judged, "none: " + half)) << "of those that leave their range";
    const Judged below =
        judge(fmt::format("#view=first&channel=N.Z&pixel=1,{}", film.window.height() - 1));
    EXPECT_TRUE(says(below, ">Not judged here: no channel has a range."));
    EXPECT_FALSE(says(below, ">No channel leaves its range here."));
    std::ranges::fill(paths.bits, 0xffffffffu);
    const Judged none = judge("#channel=N.Z");
    EXPECT_TRUE(says(none, ">No pixel is judged."));
    EXPECT_TRUE(says(none, "by the absolute difference; none is judged."));
}

/// Codes have no ranges, and all of them may be wrong while every other channel is legal: the line
/// on top says so, and how many pixels are hardly judged at all.
TEST_F(JudgePageInABrowser, SaysThatCodesDiffer) {
    if (test::sanitized) GTEST_SKIP() << runs_in_browser;
    const std::string page = judge_page(small_scene(), {{}, limits});
    const Judged judged(with_planted(page, "found ? STATUS_HIT : STATUS_FLOOR",
                                     "found ? STATUS_CAP : STATUS_FLOOR"),
                        "");
    EXPECT_EQ(judged.failing(), 0) << judged.error() << judged.verdict().dump(1);
    EXPECT_NE(judged.dom().find("Codes, which have no ranges, differ: hit.status in "),
              std::string::npos);
    // The script has the words, too, but no channel's name.
    EXPECT_EQ(Judged(page, "").dom().find("have no ranges, differ: hit."), std::string::npos);
}

/// Megabytes of a page of bricks-45, whose pictures and maps are full of detail.
double page_size(int side) {
    const Scene scene = load_scene("bricks-45", {fmt::format("size=[{},{}]", side, side)});
    JudgePage options;
    options.scene.language = "glsl-es";
    options.scene.channels = judged_channels(scene);
    const ExportContent content = export_content(scene, options.scene);
    Film film = content.expected;
    add_ragged_ranges(film);
    return static_cast<double>(judge_page_of(content, std::move(film), options, "").size()) / 1e6;
}

/// FNV-1a over the words, as the page computes it.
std::string hash_of(const std::vector<float>& values) {
    std::uint32_t hash = 2166136261u;
    for (const float value : values) hash = (hash ^ testing_films::bits(value)) * 16777619u;
    return fmt::format("{:#010x}", hash);
}

std::vector<float> floats_in(const Film& film, const std::string& name) {
    const Plane& plane = *film.find(name);
    std::vector<float> values(plane.bits.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = plane.as_float(i);
    return values;
}

/// The end that a page is to have.
std::string kept_end(const Film& film, const std::string& name, page::RangeEnd end) {
    const bool low = end == page::RangeEnd::low;
    const std::vector<float> values = floats_in(film, name),
                             bounds = floats_in(film, (low ? "gpu.lo." : "gpu.hi.") + name);
    return hash_of(page::bounds_of_codes(values, page::range_codes(values, bounds, end), end));
}

TEST_F(JudgePageInABrowser, HasTheEndsOfRangesThatItWasGiven) {
    const Scene scene = small_scene();
    JudgePage options;
    options.scene.language = "glsl-es";
    options.scene.channels = {"uv", "N", "A"};
    const ExportContent content = export_content(scene, options.scene);
    Film film = content.expected;
    add_ragged_ranges(film);
    film.find("gpu.lo.N.X")->bits[3] = testing_films::bits(-INFINITY);
    film.find("gpu.hi.N.X")->bits[3] = canonical_nan;
    const Judged judged(judge_page_of(content, film, options, ""), "");
    ASSERT_EQ(judged.error(), "");
    ASSERT_EQ(judged.verdict()["rows"].size(), 5u);
    for (const Json& row : judged.verdict()["rows"]) {
        const std::string name = row["name"];
        EXPECT_EQ(row["ends"][0], kept_end(film, name, page::RangeEnd::low)) << name;
        EXPECT_EQ(row["ends"][1], kept_end(film, name, page::RangeEnd::high)) << name;
    }
}

/// QUADREL_PAGE_SIDE=512: ctest -C Slow -R page_size
TEST(JudgePage, StaysSmall) {
    if (test::sanitized) GTEST_SKIP() << "sizes are the same as without sanitizers";
    const char* const asked = std::getenv("QUADREL_PAGE_SIDE");
    const int side = asked != nullptr ? std::atoi(asked) : 256;
    const double size = page_size(side);
    RecordProperty("megabytes", fmt::format("{:.2f}", size));
    EXPECT_LT(size, side > 256 ? 15 : 5);
    EXPECT_GT(size, side > 256 ? 8 : 3);  // else it would not hold what it should
}

}  // namespace
}  // namespace quadrel::export_tests
