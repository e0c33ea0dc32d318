#include "text/time_left.hpp"

#include <gtest/gtest.h>

namespace quadrel {
namespace {

TEST(TimeLeft, IsInUnitsThatPeopleWaitIn) {
    EXPECT_EQ(time_left(10, 0.25), "about 30 s left");
    EXPECT_EQ(time_left(60, 0.1), "about 9 min left");
    EXPECT_EQ(time_left(3600, 0.25), "about 3.0 hours left");
}

TEST(TimeLeft, IsNotSaidTooSoonNorAtTheEnd) {
    EXPECT_EQ(time_left(1, 0.1), "");
    EXPECT_EQ(time_left(100, 0.001), "");
    EXPECT_EQ(time_left(100, 0.99), "");
    EXPECT_EQ(time_left(100, 1), "");
    EXPECT_EQ(time_left(100, 0), "");
}

}  // namespace
}  // namespace quadrel
