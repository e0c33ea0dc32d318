// Whether packets look ahead: always where it pays, now and then where it does not.
#include "quadrel/relief/trace/search/look_memory.hpp"

#include <gtest/gtest.h>

namespace quadrel::test {
namespace {

const HeightMaxima some_map{}, other_map{};

/// A memory that never stops asking, and one that never asks again.
struct Eager : LookMemory {
    bool looks(const HeightMaxima*) { return true; }
};
struct Stubborn : LookMemory {
    bool gives_up = false;
    bool looks(const HeightMaxima*) { return !gives_up; }
    void learn(int gain) { gives_up = gives_up || gain < 0; }
};

/// How many of `packets` packets look, each of which then gains `gain`.
template <class Memory>
int looks_of(Memory& memory, int packets, int gain, const HeightMaxima& map = some_map) {
    int looks = 0;
    for (int i = 0; i < packets; ++i) {
        if (!memory.looks(&map)) continue;
        ++looks;
        memory.learn(gain);
    }
    return looks;
}

template <class Memory>
testing::AssertionResult goes_by_what_pays() {
    Memory memory;
    if (looks_of(memory, 1000, 5) != 1000) return testing::AssertionFailure() << "does not look";
    if (const int looks = looks_of(memory, 10000, -100); looks > 150 || looks < 50)
        return testing::AssertionFailure() << looks << " looks that lose";
    // Pays again, as soon as one has tried.
    if (const int looks = looks_of(memory, 1000, 100); looks < 800)
        return testing::AssertionFailure() << looks << " looks that gain";
    // Few that gain much are worth many that lose little.
    for (int i = 0; i < 1000; ++i)
        if (memory.looks(&some_map))
            memory.learn(i % 8 == 0 ? 200 : -10);
        else
            return testing::AssertionFailure() << "gives up a gain";
    looks_of(memory, 10000, -100);
    if (looks_of(memory, 1, -100, other_map) != 1)
        return testing::AssertionFailure() << "does not try another map";
    return testing::AssertionSuccess();
}

TEST(LookMemory, GoesByWhatPays) {
    EXPECT_TRUE(goes_by_what_pays<LookMemory>());
    EXPECT_FALSE(goes_by_what_pays<Eager>());
    EXPECT_FALSE(goes_by_what_pays<Stubborn>());
}

}  // namespace
}  // namespace quadrel::test
