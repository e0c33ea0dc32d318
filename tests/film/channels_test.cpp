#include "quadrel/film/channels.hpp"

#include <gtest/gtest.h>

#include <set>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

using Names = std::vector<std::string>;

TEST(Channels, NamesAreUniqueAndDescribed) {
    std::set<std::string> names;
    for (const ChannelInfo& channel : channel_table()) {
        EXPECT_TRUE(names.insert(channel.name).second) << channel.name;
        EXPECT_FALSE(channel.unit.empty()) << channel.name;
        EXPECT_FALSE(channel.meaning.empty()) << channel.name;
    }
    EXPECT_GT(names.size(), 60u);
}

TEST(Channels, NothingAskedForGivesTheDefault) {
    EXPECT_EQ(expand_channels({}), (Names{"R", "G", "B", "A", "Z"}));
}

TEST(Channels, GroupsStandForTheirMembers) {
    EXPECT_EQ(expand_channels(Names{"uv", "P"}), (Names{"uv.U", "uv.V", "P.X", "P.Y", "P.Z"}));
    EXPECT_EQ(expand_channels(Names{"hit.P", "hit.P.Y"}), (Names{"hit.P.X", "hit.P.Y", "hit.P.Z"}));
    EXPECT_EQ(expand_channels(Names{"shadow.3"}), (Names{"shadow.3.visibility", "shadow.3.steps"}));
    EXPECT_EQ(expand_channels(Names{"shadow"}), (Names{"shadow.visibility", "shadow.steps"}));
    EXPECT_EQ(expand_channels(Names{"J"}).size(), 6u);
    EXPECT_EQ(expand_channels(Names{"R", "G", "B"}), (Names{"R", "G", "B"}));
}

TEST(Channels, EveryExpandedNameIsKnown) {
    for (const ChannelInfo& channel : channel_table()) {
        if (channel.name.find("<channel>") != std::string::npos) continue;  // of another's name
        const std::string group = channel.name.substr(0, channel.name.find('.'));
        for (const std::string& name : expand_channels(Names{group}))
            EXPECT_NE(find_channel(name), nullptr) << name;
    }
    EXPECT_NE(find_channel("shadow.12.steps"), nullptr);
}

TEST(Channels, UnknownNamesAreRefusedWithAHint) {
    for (const char* name :
         {"", "u", "uv.", "uv.W", "shadow.01.visibility", "shadow.<i>.steps", "hit.p"})
        EXPECT_THROW(expand_channels(Names{name}), UsageError) << name;
    try {
        expand_channels(Names{"hit.stauts"});
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("\"hit.status\""), std::string::npos);
    }
}

TEST(Channels, RangesAreThoseOfFloatChannels) {
    const auto range = range_channel("gpu.paths.shadow.1.visibility");
    ASSERT_TRUE(range.has_value());
    EXPECT_EQ(range->set, "gpu");
    EXPECT_EQ(range->part, "paths");
    EXPECT_EQ(range->channel, "shadow.1.visibility");
    EXPECT_EQ(find_channel("gpu.paths.R")->type, ChannelType::uint32);
    EXPECT_EQ(range_channel("gpu.gap.hi.N.X")->part, "gap.hi");
    EXPECT_EQ(range_channel("gpu.gap.hi.N.X")->channel, "N.X");
    EXPECT_EQ(find_channel("gpu.gap.lo.N.X")->type, ChannelType::float32);
    EXPECT_EQ(find_channel("bound.lo.hit.U")->type, ChannelType::float32);
    EXPECT_EQ(expand_channels(Names{"gpu.lo.Z", "undecided"}), (Names{"gpu.lo.Z", "undecided"}));
    for (const char* name :
         {"gpu.lo.A", "gpu.lo.depth", "gpu.lo.hit.status", "gpu.lo.exact.lod.rho",
          "gpu.lo.gpu.lo.R", "bound.paths.R", "bound.gap.lo.R", "gpu.gap.R", "gpu.gap.lo.A",
          "gpu.lo", "gpu.lo.<channel>"})
        EXPECT_EQ(find_channel(name), nullptr) << name;
    EXPECT_TRUE(needs_ranges("bound.hi.R"));
    EXPECT_FALSE(needs_ranges("R"));
}

/// "gpu.lo.K" is a group as K is one, of those that have ranges.
TEST(Channels, RangesHaveGroups) {
    for (const std::string prefix :
         {"gpu.lo", "gpu.hi", "gpu.paths", "gpu.gap.lo", "gpu.gap.hi", "bound.lo", "bound.hi"}) {
        Names expected;
        for (const std::string& name : expand_channels(Names{"hit"}))
            if (has_range(name)) expected.push_back(prefix + "." + name);
        EXPECT_GT(expected.size(), 2u);
        EXPECT_LT(expected.size(), expand_channels(Names{"hit"}).size());  // hit.status has none
        EXPECT_EQ(expand_channels(Names{prefix + ".hit"}), expected);
    }
    EXPECT_EQ(expand_channels(Names{"bound.lo.K"}), (Names{"bound.lo.K.U", "bound.lo.K.V"}));
    EXPECT_EQ(expand_channels(Names{"bound.hi.shadow.2"}), Names{"bound.hi.shadow.2.visibility"});
    EXPECT_EQ(expand_channels(Names{"gpu.lo.B"}), Names{"gpu.lo.B"});  // blue, as B is
    for (const auto& [wrong, hint] : std::vector<std::pair<std::string, std::string>>{
             {"bound.lo", "as in \"bound.lo.K\""},
             {"gpu.paths", "as in \"gpu.paths.K\""},
             {"gpu.lo.hit.stauts", "did you mean"},
             {"bound.lo.Kk", "did you mean \"bound.lo.K\"?"},
             {"gpu.lo.id", "of floats, which have ranges"},
             {"bound.paths.K", "expected a channel or group"}}) {
        try {
            expand_channels(Names{wrong});
            ADD_FAILURE() << wrong;
        } catch (const UsageError& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find(hint), std::string::npos) << text;
            EXPECT_EQ(text.find("did you mean \"" + wrong + "\""), std::string::npos) << text;
        }
    }
}

TEST(Channels, UncoveredValues) {
    EXPECT_EQ(uncovered_bits("Z"), 0x7f800000u);
    EXPECT_EQ(uncovered_bits("id.object"), 0xffffffffu);
    EXPECT_EQ(uncovered_bits("hit.status"), 0u);
    EXPECT_EQ(uncovered_bits("A"), 0u);
}

}  // namespace
}  // namespace quadrel
