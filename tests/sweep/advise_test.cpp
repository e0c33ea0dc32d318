// Advice: what is cheapest of what is exact enough.
#include "sweep/advise.hpp"

#include <gtest/gtest.h>

#include "film/films.hpp"
#include "quadrel/error.hpp"
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
    std::vector<Candidate> candidates = advise(question(0.5));
    EXPECT_TRUE(is_in_order(candidates, 0.5));
    EXPECT_TRUE(candidates.front().is_good);
    std::swap(candidates.front(), candidates.back());
    EXPECT_FALSE(is_in_order(candidates, 0.5));
    std::swap(candidates.front(), candidates.back());
    const std::string text = advice_text(question(0.5), candidates, 5);
    EXPECT_NE(text.find("Cheapest: " + candidates.front().algorithm.name()), std::string::npos);
}

/// A tighter bound or a budget takes away and adds nothing.
TEST_F(Advise, LessErrorCostsNoLess) {
    const double loose = advise(question(4)).front().look_ups;
    const std::vector<Candidate> tight = advise(question(0.05));
    EXPECT_GE(tight.front().look_ups, loose);
    Question poor = question(0.05);
    poor.budget = tight.front().look_ups / 2;
    const std::vector<Candidate> none = advise(poor);
    EXPECT_FALSE(none.front().is_affordable && none.front().is_good);
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
