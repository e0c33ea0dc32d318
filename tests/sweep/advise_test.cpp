// Advice: what is cheapest of what is exact enough.
#include "sweep/advise.hpp"

#include <gtest/gtest.h>

#include <set>

#include "film/films.hpp"
#include "quadrel/error.hpp"
#include "quadrel/scene/load.hpp"
#include "sweep/made_maps.hpp"

namespace quadrel::sweep_tests {
namespace {

using namespace quadrel::sweep;

class Advise : public testing::Test {
  protected:
    /// On a map that is so small that all derived maps are made in a moment.
    Question question(double texels) const {
        PlannedMap map;
        map.kind = "fractal";
        map.size = 32;
        map.parameters["octaves"] = 3;
        Question q;
        q.scene = "rows/linear";
        q.overrides = {"material.height={\"file\":\"" +
                       write_made_map(folder.path(), map).string() +
                       "\",\"mip\":\"none\",\"min\":\"linear\"}"};
        q.texels = texels;
        q.angles = {0, 60};
        q.side = 16;
        return q;
    }
    /// The answer to question(0.5), found once.
    const Advice& advice() const {
        static const Advice found = advise(question(0.5));
        return found;
    }
    testing_films::TemporaryFolder folder;
};

/// The first ones keep the error, cheapest first, and no other does.
testing::AssertionResult is_in_order(const std::vector<Candidate>& candidates, double texels) {
    double before = 0;
    bool advised = true;
    for (const Candidate& c : candidates) {
        const bool good = c.failed.empty() && c.texels <= texels && c.is_affordable;
        if (good && !advised) return testing::AssertionFailure() << c.algorithm.name() << " late";
        if (good && c.look_ups < before) return testing::AssertionFailure() << c.algorithm.name();
        before = c.look_ups;
        advised = good;
    }
    return testing::AssertionSuccess();
}

TEST_F(Advise, CheapestFirst) {
    std::vector<Candidate> candidates = advice().searches;
    EXPECT_TRUE(is_in_order(candidates, 0.5));
    EXPECT_TRUE(candidates.front().is_good);
    std::swap(candidates.front(), candidates.back());
    EXPECT_FALSE(is_in_order(candidates, 0.5));
    const std::string text = advice_text(question(0.5), advice(), 5);
    EXPECT_NE(text.find("Cheapest: " + advice().searches.front().algorithm.name()),
              std::string::npos);
}

/// The searches that a list has, which of the two surfaces apart.
std::set<std::string> traces_of(const std::vector<Candidate>& candidates) {
    std::set<std::string> traces;
    for (const Candidate& c : candidates) traces.insert(c.algorithm.trace);
    return traces;
}

/// Exact hits of another surface are no exact hits of the scene: they are not its ranking's, and
/// not its cheapest, though they would be by their look-ups.
TEST_F(Advise, TheScenesOwnSurfaceIsRanked) {
    const Advice& patches = advice();
    EXPECT_EQ(patches.surface, oracle::Surface::bilinear);
    const std::set<std::string> blocks{"pyramid", "qdm"};
    EXPECT_EQ(traces_of(patches.others), blocks);
    for (const Candidate& c : patches.searches)
        EXPECT_TRUE(!c.failed.empty() || c.surface == patches.surface) << c.algorithm.name();
    EXPECT_TRUE(patches.others.front().is_good);
    EXPECT_EQ(patches.others.front().texels, 0);
    const std::string text = advice_text(question(0.5), patches, 50);
    const std::size_t apart = text.find("Not of this surface: the scene draws bilinear patches");
    ASSERT_NE(apart, std::string::npos) << text;
    EXPECT_GT(text.find("| pyramid "), apart);
    EXPECT_LT(text.find("| max-mip "), apart);

    // Where the scene's own search meets blocks it is the other way round.
    Question of_blocks = question(0.5);
    of_blocks.overrides.emplace_back("material.relief.trace=qdm");
    const Advice swapped = advise(of_blocks);
    EXPECT_EQ(swapped.surface, oracle::Surface::block);
    EXPECT_EQ(traces_of(swapped.searches), blocks);
    EXPECT_TRUE(traces_of(swapped.others).contains("max-mip"));
    // And where it has none, its sampler says how texels are read.
    Question plain = question(0.5);
    plain.overrides.emplace_back("material.relief.trace=trace-none");
    const auto surface = [&] { return surface_of_scene(load_scene(plain.scene, plain.overrides)); };
    EXPECT_EQ(surface(), oracle::Surface::bilinear);
    plain.overrides.emplace_back("material.height.min=nearest");
    plain.overrides.emplace_back("material.height.mag=nearest");
    EXPECT_EQ(surface(), oracle::Surface::block);
}

TEST_F(Advise, JsonHasBothRankings) {
    const Json json = advice_json(question(0.5), advice());
    EXPECT_EQ(json["surface"], "bilinear");
    EXPECT_EQ(json["cheapest"], advice().searches.front().algorithm.name());
    EXPECT_EQ(json["searches"][0]["search"], json["cheapest"]);
    EXPECT_EQ(json["searches"].size() + json["not_judged"].size(), advice().searches.size());
    EXPECT_EQ(json["other_surfaces"].size(), advice().others.size());
    for (const Json& search : json["searches"]) EXPECT_EQ(search["surface"], "bilinear");
    for (const Json& search : json["other_surfaces"]) EXPECT_EQ(search["surface"], "block");
    Advice none = advice();
    for (Candidate& c : none.searches) c.is_affordable = false;
    EXPECT_TRUE(advice_json(question(0.5), none)["cheapest"].is_null());
}

/// A tighter bound or a budget takes away and adds nothing.
TEST_F(Advise, LessErrorCostsNoLess) {
    const double loose = advise(question(4)).searches.front().look_ups;
    const std::vector<Candidate> tight = advise(question(0.05)).searches;
    EXPECT_GE(tight.front().look_ups, loose);
    Question poor = question(0.05);
    poor.budget = tight.front().look_ups / 2;
    const Advice none = advise(poor);
    EXPECT_FALSE(keeps_all(none.searches.front()));
    EXPECT_NE(advice_text(poor, none, 5).find("No search keeps that."), std::string::npos);
}

TEST_F(Advise, Words) {
    EXPECT_EQ(parse_texels("0.5texel"), 0.5);
    EXPECT_EQ(parse_texels("2texels"), 2);
    EXPECT_EQ(parse_texels("1e-3"), 1e-3);
    EXPECT_EQ(parse_angles("0..75"), (std::vector<double>{0, 15, 30, 45, 60, 75}));
    EXPECT_EQ(parse_angles("10..30:8"), (std::vector<double>{10, 18, 26, 30}));
    EXPECT_EQ(parse_angles("45..45"), (std::vector<double>{45}));
    EXPECT_EQ(parse_angles("0,30,60"), (std::vector<double>{0, 30, 60}));
    for (const char* wrong : {"", "texel", "-1", "0", "nan", "inf", "0.5px", "1e9"})
        EXPECT_THROW(parse_texels(wrong), UsageError) << wrong;
    for (const char* wrong : {"", "..", "0..", "75..0", "0..90", "0..75:0", "0..75:", "30,0", "a",
                              "0,", "nan", "-5..5", "1..2..3"})
        EXPECT_THROW(parse_angles(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace quadrel::sweep_tests
