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

TEST(Channels, UncoveredValues) {
    EXPECT_EQ(uncovered_bits("Z"), 0x7f800000u);
    EXPECT_EQ(uncovered_bits("id.object"), 0xffffffffu);
    EXPECT_EQ(uncovered_bits("hit.status"), 0u);
    EXPECT_EQ(uncovered_bits("A"), 0u);
}

}  // namespace
}  // namespace quadrel
